# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures on the device: one, or several of one size in layers."""

from __future__ import annotations

import math

import numpy as np

from .buffer import Buffer
from .calls import Calls, check_memory, delete, generate

_TEXTURE_2D, _TEXTURE_2D_ARRAY, _TEXTURE0, _READ_WRITE = 0x0DE1, 0x8C1A, 0x84C0, 0x88BA
_PIXEL_PACK_BUFFER, _PACK_ALIGNMENT, _UNPACK_ALIGNMENT = 0x88EB, 0x0D05, 0x0CF5
_MIN_FILTER, _MAG_FILTER, _WRAP_S, _WRAP_T = 0x2801, 0x2800, 0x2802, 0x2803
_NEAREST, _LINEAR, _LINEAR_MIPMAP_LINEAR, _REPEAT, _CLAMP_TO_EDGE = 0x2600, 0x2601, 0x2703, 0x2901, 0x812F
_FLOAT, _UNSIGNED_INT = 0x1406, 0x1405

_FORMATS = {  # of (channels, dtype): as it is stored, the channels and their type as the host sees them
    (4, "f4"): (0x8814, 0x1908, _FLOAT),
    (4, "u4"): (0x8D70, 0x8D99, _UNSIGNED_INT),
    (1, "u4"): (0x8236, 0x8D94, _UNSIGNED_INT)}

SPARE_UNIT = 31  # where textures are made and changed, so that those which programs read stay where they are


class Texture:
    """A picture of (width, height) pixels, unset, nearest filter, clamped. GpuError if there is no room.

    glo    the name that OpenGL gave it
    dtype  of its channels: f4, or u4
    """

    target = _TEXTURE_2D

    def __init__(self, calls: Calls, size: tuple[int, int], channels: int, dtype: str) -> None:
        self._calls, self.size = calls, size
        self._shape, self.dtype = self._shape_of(channels), np.dtype(dtype)
        self.format, self._channels, self._type = _FORMATS[channels, dtype]
        self.glo = generate(calls, "Textures")
        self._select()
        self._reserve()
        check_memory(calls)
        self.set_filter(is_smooth=False)
        for axis in (_WRAP_S, _WRAP_T):
            calls["glTexParameteri"](self.target, axis, _CLAMP_TO_EDGE)

    @property
    def n_bytes(self) -> int:
        """Its size without mip levels."""
        return math.prod(self._shape) * self.dtype.itemsize

    def read(self) -> np.ndarray:
        """(height, width, channels) of its dtype, layers before; waits for the device."""
        pixels = np.empty(self._shape, self.dtype)
        self._select()
        self._calls["glPixelStorei"](_PACK_ALIGNMENT, 1)
        self._calls["glGetTexImage"](self.target, 0, self._channels, self._type, pixels.ctypes.data)
        return pixels

    def copy_to(self, buffer: Buffer) -> None:
        """Put the same into a buffer, on the device."""
        assert buffer.size >= self.n_bytes
        self._select()
        self._calls["glBindBuffer"](_PIXEL_PACK_BUFFER, buffer.glo)
        self._calls["glPixelStorei"](_PACK_ALIGNMENT, 1)
        self._calls["glGetTexImage"](self.target, 0, self._channels, self._type, None)
        self._calls["glBindBuffer"](_PIXEL_PACK_BUFFER, 0)

    def write(self, pixels: np.ndarray) -> None:
        """Copy what `read` gives back."""
        pixels = np.ascontiguousarray(pixels, self.dtype)
        assert pixels.size == math.prod(self._shape)
        self._select()
        self._calls["glPixelStorei"](_UNPACK_ALIGNMENT, 1)
        self._fill(pixels)

    def set_filter(self, is_smooth: bool) -> None:
        """Whether it is sampled between its texels, or the nearest one."""
        filter_ = _LINEAR if is_smooth else _NEAREST
        self._parameters((_MIN_FILTER, filter_), (_MAG_FILTER, filter_))

    def go_round(self) -> None:
        """Begin anew at the left where it ends on the right."""
        self._parameters((_WRAP_S, _REPEAT))

    def build_mipmaps(self) -> None:
        """Make the smaller levels, and sample between texels and levels."""
        self._select()
        self._calls["glGenerateMipmap"](self.target)
        self._parameters((_MIN_FILTER, _LINEAR_MIPMAP_LINEAR), (_MAG_FILTER, _LINEAR))

    def use(self, unit: int) -> None:
        """Bind for sampling."""
        self._calls["glActiveTexture"](_TEXTURE0 + unit)
        self._calls["glBindTexture"](self.target, self.glo)

    def bind_image(self, unit: int) -> None:
        """Bind as an image, with all layers, for reading and writing."""
        self._calls["glBindImageTexture"](unit, self.glo, 0, self.target != _TEXTURE_2D, 0, _READ_WRITE, self.format)

    def release(self) -> None:
        """Give it back."""
        delete(self._calls, "Textures", self.glo)

    def _select(self) -> None:
        self.use(SPARE_UNIT)

    def _parameters(self, *pairs: tuple[int, int]) -> None:
        self._select()
        for name, value in pairs:
            self._calls["glTexParameteri"](self.target, name, value)

    def _shape_of(self, channels: int) -> tuple[int, ...]:
        return self.size[1], self.size[0], channels

    def _reserve(self) -> None:
        self._calls["glTexImage2D"](self.target, 0, self.format, *self.size, 0, self._channels, self._type, None)

    def _fill(self, pixels: np.ndarray) -> None:
        self._calls["glTexSubImage2D"](self.target, 0, 0, 0, *self.size, self._channels, self._type, pixels.ctypes.data)


class Layers(Texture):
    """n pictures RGBA f4 of one size."""

    target = _TEXTURE_2D_ARRAY

    def __init__(self, calls: Calls, size: tuple[int, int], n: int) -> None:
        self.n = n
        super().__init__(calls, size, 4, "f4")

    def clear(self) -> None:
        """Fill all with zeros, on the device where OpenGL is new enough for that."""
        if "glClearTexImage" in self._calls:
            self._calls["glClearTexImage"](self.glo, 0, self._channels, self._type, None)
        else:
            self.write(np.zeros(self._shape, "f4"))

    def _shape_of(self, channels: int) -> tuple[int, ...]:
        return self.n, *super()._shape_of(channels)

    def _reserve(self) -> None:
        self._calls["glTexImage3D"](self.target, 0, self.format, *self.size, self.n, 0, self._channels, self._type,
                                    None)

    def _fill(self, pixels: np.ndarray) -> None:
        self._calls["glTexSubImage3D"](self.target, 0, 0, 0, 0, *self.size, self.n, self._channels, self._type,
                                       pixels.ctypes.data)
