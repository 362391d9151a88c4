# SPDX-License-Identifier: GPL-3.0-or-later
"""A cube of texels with all its mip levels.

Storage for the levels is asked for, not made by generating them, which takes NVIDIA's driver tens of milliseconds.
"""

from __future__ import annotations

from .calls import Calls, check_memory, delete, generate
from .texture import SPARE_UNIT

_TEXTURE_3D, _TEXTURE0 = 0x806F, 0x84C0
_RGBA16F, _RGBA, _HALF_FLOAT, _READ_WRITE = 0x881A, 0x1908, 0x140B, 0x88BA
_PARAMETERS = ((0x2801, 0x2703), (0x2800, 0x2601), (0x2802, 0x812F), (0x2803, 0x812F), (0x8072, 0x812F))
"""Minification: linear between linear levels; magnification: linear; clamped to the edge along s, t, r."""


class Cube:
    """A 3D texture RGBA f2 of n^3 texels, linear filters, clamped; level 0 holds zeros, the other levels are unset."""

    def __init__(self, calls: Calls, n: int) -> None:
        self.n = n
        self.n_levels = n.bit_length()
        self._calls = calls
        self.glo = generate(calls, "Textures")
        self.use(SPARE_UNIT)
        calls["glTexStorage3D"](_TEXTURE_3D, self.n_levels, _RGBA16F, n, n, n)
        check_memory(calls)
        for parameter, value in _PARAMETERS:
            calls["glTexParameteri"](_TEXTURE_3D, parameter, value)
        self._clear()

    @property
    def n_bytes(self) -> int:
        """Size of all levels."""
        return sum(8 * (self.n >> level) ** 3 for level in range(self.n_levels))

    def use(self, unit: int) -> None:
        """Bind for sampling."""
        self._calls["glActiveTexture"](_TEXTURE0 + unit)
        self._calls["glBindTexture"](_TEXTURE_3D, self.glo)

    def bind_level(self, unit: int, level: int) -> None:
        """Bind all layers of one level as an image for reading and writing."""
        self._calls["glBindImageTexture"](unit, self.glo, level, 1, 0, _READ_WRITE, _RGBA16F)

    def release(self) -> None:
        """Give the memory back."""
        delete(self._calls, "Textures", self.glo)

    def _clear(self) -> None:
        if "glClearTexImage" in self._calls:
            self._calls["glClearTexImage"](self.glo, 0, _RGBA, _HALF_FLOAT, None)
        else:
            n, zeros = self.n, bytes(8 * self.n**3)
            self._calls["glTexSubImage3D"](_TEXTURE_3D, 0, 0, 0, 0, n, n, n, _RGBA, _HALF_FLOAT, zeros)
