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

import moderngl
import numpy as np

from ..errors import GpuError
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


class Oidn:
    """The filter for pictures of one size: on the card that draws, with CUDA, or else where the library likes to run.

    is_clean  whether the guides have no noise of their own
    GpuError if the library cannot.
    """

    def __init__(self, cuda: Cuda | None, buffers: Sequence[moderngl.Buffer], size: tuple[int, int], quality: str,
                 is_clean: bool) -> None:
        self._api = library()
        if self._api is None:
            raise GpuError("Open Image Denoise was not found")
        self._size, self._gl, self._cuda = size, buffers, cuda
        self._n_bytes = size[0] * size[1] * _RGBA
        with ExitStack() as made:
            self._device = self._make_device(made)
            self._shared = made.enter_context(cuda.share(buffers)) if cuda else None
            self._filter = self._own(made, "Filter", self._api.oidnNewFilter(self._device, b"RT"))
            self._api.oidnSetFilterBool(self._filter, b"hdr", True)
            self._api.oidnSetFilterBool(self._filter, b"cleanAux", is_clean)
            self._api.oidnSetFilterInt(self._filter, b"quality", QUALITIES[quality])
            self._pointers: list[int] = []
            self._views = made.enter_context(ExitStack())
            self._buffers: list[Any] = []
            if not cuda:
                self._view([self._api.oidnNewBuffer(self._device, self._n_bytes) for _ in IMAGES])
            self._check()
            self._made = made.pop_all()

    def run(self, pixels: np.ndarray, staging: moderngl.Buffer) -> None:
        """Fill `pixels` (height, width, 4) f4 with the first of the buffers, filtered by the others.

        staging  a buffer for the host, of the same size
        """
        if self._shared:
            with self._shared.mapped() as pointers:
                if pointers != self._pointers:
                    self._pointers = pointers
                    self._view([self._api.oidnNewSharedBuffer(self._device, p, self._n_bytes) for p in pointers])
                self._execute()
            self._gl[0].ctx.copy_buffer(staging, self._gl[0])
            staging.read_into(pixels)
            return
        for gl, buffer in zip(reversed(self._gl), reversed(self._buffers), strict=True):
            gl.read_into(pixels)
            self._api.oidnWriteBuffer(buffer, 0, self._n_bytes, pixels.ctypes.data)
        self._execute()
        self._api.oidnReadBuffer(self._buffers[0], 0, self._n_bytes, pixels.ctypes.data)
        self._check()

    def close(self) -> None:
        """Give all back."""
        self._made.close()

    def _make_device(self, made: ExitStack) -> Any:
        if self._cuda:
            number, stream = ctypes.c_int(self._cuda.number), _P()
            device = self._api.oidnNewCUDADevice(ctypes.byref(number), ctypes.byref(stream), 1)
        else:
            device = self._api.oidnNewDevice(_ANY_DEVICE)
        self._own(made, "Device", device)
        self._api.oidnSetDeviceBool(device, b"setAffinity", False)  # other work wants the same processors
        self._api.oidnCommitDevice(device)
        return device

    def _own(self, made: ExitStack, kind: str, thing: Any) -> Any:
        made.callback(getattr(self._api, f"oidnRelease{kind}"), thing)
        return thing

    def _view(self, buffers: list[Any]) -> None:
        """Filter from and into these."""
        self._views.close()
        self._buffers = [self._own(self._views, "Buffer", buffer) for buffer in buffers]
        width, height = self._size
        for name, buffer in (*zip(IMAGES, self._buffers, strict=True), ("output", self._buffers[0])):
            self._api.oidnSetFilterImage(self._filter, name.encode(), buffer, _FLOAT3, width, height, 0, _RGBA,
                                         _RGBA * width)
        self._api.oidnCommitFilter(self._filter)

    def _execute(self) -> None:
        self._api.oidnExecuteFilter(self._filter)
        self._check()

    def _check(self) -> None:
        message = _TEXT()
        if self._api.oidnGetDeviceError(self._device, ctypes.byref(message)):
            raise GpuError(f"Open Image Denoise failed: {(message.value or b'').decode(errors='replace')}")
