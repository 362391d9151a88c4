# SPDX-License-Identifier: GPL-3.0-or-later
"""Storage buffers: bytes on the device."""

from __future__ import annotations

import ctypes

import numpy as np

from .calls import Calls, check_memory, delete, generate

_COPY_READ, _COPY_WRITE, _STATIC_DRAW, _DYNAMIC_DRAW = 0x8F36, 0x8F37, 0x88E4, 0x88E8
_MAP_READ = 1
_R32UI, _RED_INTEGER, _UNSIGNED_INT = 0x8236, 0x8D94, 0x1405

# Bytes from which reading them where they lie is quicker: of a picture, an H200 gives 8 MB in half the time
_LARGE = 1 << 16


class Buffer:
    """`size` bytes, unset. GpuError if there is no room.

    glo       the name that OpenGL gave it
    for_host  a hint: that the host reads it often
    """

    def __init__(self, calls: Calls, size: int, for_host: bool = False) -> None:
        self.size = size
        self._calls = calls
        self.glo = generate(calls, "Buffers")
        calls["glBindBuffer"](_COPY_WRITE, self.glo)
        calls["glBufferData"](_COPY_WRITE, size, None, _DYNAMIC_DRAW if for_host else _STATIC_DRAW)
        check_memory(calls)

    def read(self, size: int = -1, offset: int = 0) -> bytes:
        """`size` bytes, or all, from `offset` on; waits for the device."""
        data = np.empty(self.size - offset if size < 0 else size, "u1")
        self.read_into(data, offset)
        return data.tobytes()

    def read_into(self, array: np.ndarray, offset: int = 0) -> None:
        """Fill a whole array, which lies in one piece; waits for the device."""
        assert array.flags.c_contiguous and offset + array.nbytes <= self.size
        self._calls["glBindBuffer"](_COPY_READ, self.glo)
        if array.nbytes >= _LARGE:
            at = self._calls["glMapBufferRange"](_COPY_READ, offset, array.nbytes, _MAP_READ)
            ctypes.memmove(array.ctypes.data, at, array.nbytes)
            self._calls["glUnmapBuffer"](_COPY_READ)
        elif array.nbytes:
            self._calls["glGetBufferSubData"](_COPY_READ, offset, array.nbytes, array.ctypes.data)

    def write(self, data: bytes | np.ndarray, offset: int = 0) -> None:
        """Copy bytes, or an array, to `offset` and after it."""
        array = np.frombuffer(data, "u1") if isinstance(data, bytes) else np.ascontiguousarray(data)
        assert offset + array.nbytes <= self.size
        if array.nbytes:
            self._calls["glBindBuffer"](_COPY_WRITE, self.glo)
            self._calls["glBufferSubData"](_COPY_WRITE, offset, array.nbytes, array.ctypes.data)

    def clear(self, n_bytes: int = -1) -> None:
        """Fill it, or its first n_bytes, with zeros: on the device, since a write may move it to slow memory."""
        n_bytes = self.size if n_bytes < 0 else n_bytes
        assert n_bytes % 4 == 0 and n_bytes <= self.size
        self._calls["glBindBuffer"](_COPY_WRITE, self.glo)
        self._calls["glClearBufferSubData"](_COPY_WRITE, _R32UI, 0, n_bytes, _RED_INTEGER, _UNSIGNED_INT, None)

    def copy_from(self, source: Buffer, size: int = -1, read_offset: int = 0, write_offset: int = 0) -> None:
        """Copy `size` bytes of another buffer, or all of it, on the device."""
        size = source.size - read_offset if size < 0 else size
        assert read_offset + size <= source.size and write_offset + size <= self.size
        self._calls["glBindBuffer"](_COPY_READ, source.glo)
        self._calls["glBindBuffer"](_COPY_WRITE, self.glo)
        self._calls["glCopyBufferSubData"](_COPY_READ, _COPY_WRITE, read_offset, write_offset, size)

    def release(self) -> None:
        """Give it back."""
        delete(self._calls, "Buffers", self.glo)
