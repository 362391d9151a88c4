# SPDX-License-Identifier: GPL-3.0-or-later
"""CUDA's view of OpenGL's buffers, where NVIDIA's driver draws: other libraries work on them without a copy."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from ..errors import GpuError
from .buffer import Buffer

_NAMES = {"linux": "libcuda.so.1", "win32": "nvcuda.dll"}
_ALL_DEVICES = 1


class Cuda:
    """The CUDA device that the current OpenGL context draws with. GpuError if there is none.

    number  the device's, as CUDA counts
    """

    def __init__(self) -> None:
        try:
            self._api = ctypes.CDLL(_NAMES[sys.platform])
        except (OSError, KeyError) as error:
            raise GpuError(f"CUDA was not found: {error}") from error
        number, n, context = ctypes.c_int(), ctypes.c_uint(), ctypes.c_void_p()
        self.call("cuInit", 0)
        self.call("cuGLGetDevices_v2", ctypes.byref(n), ctypes.byref(number), 1, _ALL_DEVICES)
        if not n.value:
            raise GpuError("OpenGL does not draw with a device of CUDA's")
        self.number = number.value
        self.call("cuDevicePrimaryCtxRetain", ctypes.byref(context), number)
        self._context = context

    def call(self, name: str, *arguments: Any) -> None:
        """A function of CUDA's driver."""
        if code := getattr(self._api, name)(*arguments):
            raise GpuError(f"CUDA failed: {name} gave {code}")

    @contextmanager
    def share(self, buffers: Sequence[Buffer]) -> Iterator[Shared]:
        """`buffers`, so that CUDA can map them."""
        resources = (ctypes.c_void_p * len(buffers))()
        try:
            with self.current():
                for i, buffer in enumerate(buffers):
                    self.call("cuGraphicsGLRegisterBuffer", ctypes.byref(resources, i * ctypes.sizeof(ctypes.c_void_p)),
                              ctypes.c_uint(buffer.glo), 0)
            yield Shared(self, resources)
        finally:
            with self.current():
                for resource in filter(None, resources):
                    self.call("cuGraphicsUnregisterResource", ctypes.c_void_p(resource))

    @contextmanager
    def current(self) -> Iterator[None]:
        """CUDA's context, current on this thread."""
        self.call("cuCtxPushCurrent_v2", self._context)
        try:
            yield
        finally:
            self.call("cuCtxPopCurrent_v2", ctypes.byref(ctypes.c_void_p()))

    def close(self) -> None:
        """Give the context back."""
        self.call("cuDevicePrimaryCtxRelease_v2", self.number)


class Shared:
    """OpenGL's buffers that CUDA can map."""

    def __init__(self, cuda: Cuda, resources: Any) -> None:
        self._cuda, self._resources = cuda, resources

    @contextmanager
    def mapped(self) -> Iterator[list[int]]:
        """Their addresses on the device, after all that OpenGL was told to do; OpenGL must leave them alone inside."""
        cuda, n = self._cuda, len(self._resources)
        with cuda.current():
            cuda.call("cuGraphicsMapResources", n, self._resources, None)
            try:
                yield [self._address(resource) for resource in self._resources]
            finally:
                cuda.call("cuGraphicsUnmapResources", n, self._resources, None)

    def _address(self, resource: int) -> int:
        address, n_bytes = ctypes.c_void_p(), ctypes.c_size_t()
        self._cuda.call("cuGraphicsResourceGetMappedPointer_v2", ctypes.byref(address), ctypes.byref(n_bytes),
                        ctypes.c_void_p(resource))
        return address.value or 0
