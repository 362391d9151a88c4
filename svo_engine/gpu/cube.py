# SPDX-License-Identifier: GPL-3.0-or-later
"""A cube of texels with all its mip levels, by the OpenGL calls that moderngl lacks.

moderngl gives a 3D texture storage for its levels only by generating them, which takes NVIDIA's driver tens of
milliseconds, and binds it as an image with one layer alone.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from typing import Any

_TEXTURE_3D, _TEXTURE0 = 0x806F, 0x84C0
_RGBA16F, _RGBA, _HALF_FLOAT, _READ_WRITE = 0x881A, 0x1908, 0x140B, 0x88BA
_PARAMETERS = ((0x2801, 0x2703), (0x2800, 0x2601), (0x2802, 0x812F), (0x2803, 0x812F), (0x8072, 0x812F))
"""Minification: linear between linear levels; magnification: linear; clamped to the edge along s, t, r."""

_U, _I, _P = ctypes.c_uint, ctypes.c_int, ctypes.c_void_p
_SIGNATURES: dict[str, tuple[Any, ...]] = {
    "glGenTextures": (_I, _P),
    "glDeleteTextures": (_I, _P),
    "glActiveTexture": (_U,),
    "glBindTexture": (_U, _U),
    "glTexParameteri": (_U, _U, _I),
    "glTexBuffer": (_U, _U, _U),
    "glTexStorage3D": (_U, _I, _U, _I, _I, _I),
    "glTexSubImage3D": (_U, _I, _I, _I, _I, _I, _I, _I, _U, _U, _P),
    "glBindImageTexture": (_U, _U, _I, ctypes.c_ubyte, _I, _U, _U),
    "glProgramUniform1i": (_U, _I, _I),
    "glClearTexImage": (_U, _I, _U, _U, _P),
}

Calls = dict[str, Callable[..., None]]


def load_calls(loader: Any) -> Calls:
    """The OpenGL functions of the current context; glClearTexImage is newer than OpenGL 4.3 and may be missing."""
    prototype = getattr(ctypes, "WINFUNCTYPE" if sys.platform == "win32" else "CFUNCTYPE")
    addresses = {name: loader.load_opengl_function(name) for name in _SIGNATURES}
    return {name: prototype(None, *_SIGNATURES[name])(address) for name, address in addresses.items() if address}


class Cube:
    """A 3D texture RGBA f2 of n^3 texels, linear filters, clamped; level 0 holds zeros, the other levels are unset."""

    def __init__(self, calls: Calls, n: int) -> None:
        self.n = n
        self.n_levels = n.bit_length()
        self._calls = calls
        name = ctypes.c_uint()
        calls["glGenTextures"](1, ctypes.byref(name))
        self.glo = name.value
        calls["glBindTexture"](_TEXTURE_3D, self.glo)
        calls["glTexStorage3D"](_TEXTURE_3D, self.n_levels, _RGBA16F, n, n, n)
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
        self._calls["glDeleteTextures"](1, ctypes.byref(ctypes.c_uint(self.glo)))

    def _clear(self) -> None:
        if "glClearTexImage" in self._calls:
            self._calls["glClearTexImage"](self.glo, 0, _RGBA, _HALF_FLOAT, None)
        else:
            n, zeros = self.n, bytes(8 * self.n**3)
            self._calls["glTexSubImage3D"](_TEXTURE_3D, 0, 0, 0, 0, n, n, n, _RGBA, _HALF_FLOAT, zeros)
