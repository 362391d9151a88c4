# SPDX-License-Identifier: GPL-3.0-or-later
"""Open Image Denoise [Afra25], the library that Blender brings along: a picture without noise, by a neural network."""

from __future__ import annotations

import ctypes
import importlib.util
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import GpuError
from .buffer import Buffer
from .cuda import Cuda

QUALITIES = {"high": 6, "balanced": 5, "fast": 4}
IMAGES = ("color", "albedo", "normal")  # what a picture is filtered by; the first one is the picture

_NAMES = {"linux": "libOpenImageDenoise.so.2", "win32": "OpenImageDenoise.dll"}
_ANY_DEVICE, _FLOAT3, _RGBA = 0, 3, 16  # the last one: bytes of a pixel, whose alpha is left alone
_I, _S, _P, _TEXT = ctypes.c_int, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_char_p
_SIGNATURES: dict[str, tuple[Any, ...]] = {  # what it gives, what it takes
    "oidnNewDevice": (_P, _I),
    "oidnNewCUDADevice": (_P, _P, _P, _I),
    "oidnSetDeviceBool": (None, _P, _TEXT, ctypes.c_bool),
    "oidnCommitDevice": (None, _P),
    "oidnReleaseDevice": (None, _P),
    "oidnGetDeviceError": (_I, _P, _P),
    "oidnNewBuffer": (_P, _P, _S),
    "oidnNewSharedBuffer": (_P, _P, _P, _S),
    "oidnWriteBuffer": (None, _P, _S, _S, _P),
    "oidnReadBuffer": (None, _P, _S, _S, _P),
    "oidnReleaseBuffer": (None, _P),
    "oidnNewFilter": (_P, _P, _TEXT),
    "oidnSetFilterImage": (None, _P, _TEXT, _P, _I, _S, _S, _S, _S, _S),
    "oidnSetFilterBool": (None, _P, _TEXT, ctypes.c_bool),
    "oidnSetFilterInt": (None, _P, _TEXT, _I),
    "oidnCommitFilter": (None, _P),
    "oidnExecuteFilter": (None, _P),
    "oidnReleaseFilter": (None, _P),
}


@cache
def library() -> Any:
    """The library, or None: what this process has already, what the system has, or what lies in Blender's module."""
    for path in _paths():
        try:
            loaded = ctypes.CDLL(path)
            for name, (gives, *takes) in _SIGNATURES.items():
                function = getattr(loaded, name)
                function.restype, function.argtypes = gives, takes
            return loaded
        except (OSError, AttributeError):
            continue
    return None


def _paths() -> Iterator[str]:
    if name := _NAMES.get(sys.platform):
        yield name
        try:
            spec = importlib.util.find_spec("bpy")
        except ValueError:  # inside Blender's own program, which has it loaded
            return
        for folder in (spec and spec.submodule_search_locations) or ():
            yield str(Path(folder) / "lib" / name)


class OidnDevice:
    """What filters run on: the card that draws, if that is one with CUDA, or else where the library likes to run.

    GpuError if there is no library or it cannot.
    """

    def __init__(self, cuda: Cuda | None) -> None:
        self.api, self.cuda = library(), cuda
        if self.api is None:
            raise GpuError("Open Image Denoise was not found")
        if cuda:
            number, stream = ctypes.c_int(cuda.number), _P()
            self.handle = self.api.oidnNewCUDADevice(ctypes.byref(number), ctypes.byref(stream), 1)
        else:
            self.handle = self.api.oidnNewDevice(_ANY_DEVICE)
        self.api.oidnSetDeviceBool(self.handle, b"setAffinity", False)  # other work wants the same processors
        self.api.oidnCommitDevice(self.handle)
        try:
            self.check()
        except GpuError:
            self.close()
            raise

    def check(self) -> None:
        """Raise GpuError with what the library has to say of its last error, if there was one."""
        message = _TEXT()
        if self.api.oidnGetDeviceError(self.handle, ctypes.byref(message)):
            raise GpuError(f"Open Image Denoise failed: {(message.value or b'').decode(errors='replace')}")

    def close(self) -> None:
        """Give it back, after all of its filters."""
        self.api.oidnReleaseDevice(self.handle)


class Oidn:
    """The filter for pictures of one size, in buffers of OpenGL's: one for each of IMAGES.

    is_clean  whether the guides have no noise of their own
    GpuError if the library cannot.
    """

    def __init__(self, device: OidnDevice, images: Sequence[Buffer], size: tuple[int, int], quality: str,
                 is_clean: bool) -> None:
        self._device, self._api, self._size, self._images = device, device.api, size, images
        self._n_bytes = size[0] * size[1] * _RGBA
        self._addresses: list[int] = []
        self._buffers: list[Any] = []
        with ExitStack() as made:
            self._shared = made.enter_context(device.cuda.share(images)) if device.cuda else None
            self._filter = self._api.oidnNewFilter(device.handle, b"RT")
            made.callback(self._api.oidnReleaseFilter, self._filter)
            self._api.oidnSetFilterBool(self._filter, b"hdr", True)
            self._api.oidnSetFilterBool(self._filter, b"cleanAux", is_clean)
            self._api.oidnSetFilterInt(self._filter, b"quality", QUALITIES[quality])
            self._views = made.enter_context(ExitStack())
            if not self._shared:
                self._view([self._api.oidnNewBuffer(device.handle, self._n_bytes) for _ in IMAGES])
            device.check()
            self._made = made.pop_all()

    def run(self, pixels: np.ndarray, staging: Buffer) -> None:
        """Fill `pixels` (height, width, 4) f4 with the first of the images, filtered by the others.

        staging  a buffer for the host, of the same size
        """
        if self._shared:
            with self._shared.mapped() as addresses:
                if addresses != self._addresses:
                    self._addresses = addresses
                    self._view([self._api.oidnNewSharedBuffer(self._device.handle, address, self._n_bytes)
                                for address in addresses])
                self._execute()
            staging.copy_from(self._images[0])
            staging.read_into(pixels)
            return
        for image, buffer in zip(reversed(self._images), reversed(self._buffers), strict=True):
            image.read_into(pixels)
            self._api.oidnWriteBuffer(buffer, 0, self._n_bytes, pixels.ctypes.data)
        self._execute()
        self._api.oidnReadBuffer(self._buffers[0], 0, self._n_bytes, pixels.ctypes.data)
        self._device.check()

    def close(self) -> None:
        """Give all back."""
        self._made.close()

    def _view(self, buffers: list[Any]) -> None:
        """Filter from and into these."""
        self._views.close()
        self._buffers = buffers
        for buffer in buffers:
            self._views.callback(self._api.oidnReleaseBuffer, buffer)
        width, height = self._size
        for name, buffer in (*zip(IMAGES, buffers, strict=True), ("output", buffers[0])):
            self._api.oidnSetFilterImage(self._filter, name.encode(), buffer, _FLOAT3, width, height, 0, _RGBA,
                                         _RGBA * width)
        self._api.oidnCommitFilter(self._filter)

    def _execute(self) -> None:
        self._api.oidnExecuteFilter(self._filter)
        self._device.check()
