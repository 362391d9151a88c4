# SPDX-License-Identifier: GPL-3.0-or-later
"""The OpenGL calls that moderngl lacks, or makes by way of the host."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from typing import Any

_SHADER_STORAGE_BUFFER = 0x90D2
_R32UI, _RED_INTEGER, _UNSIGNED_INT, _RGBA, _FLOAT = 0x8236, 0x8D94, 0x1405, 0x1908, 0x1406

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
    "glBindBuffer": (_U, _U),
    "glClearBufferData": (_U, _U, _U, _U, _P),
    "glFlush": (),
}

Calls = dict[str, Callable[..., None]]


def load_calls(loader: Any) -> Calls:
    """The OpenGL functions of the current context; glClearTexImage is newer than OpenGL 4.3 and may be missing."""
    prototype = getattr(ctypes, "WINFUNCTYPE" if sys.platform == "win32" else "CFUNCTYPE")
    addresses = {name: loader.load_opengl_function(name) for name in _SIGNATURES}
    return {name: prototype(None, *_SIGNATURES[name])(address) for name, address in addresses.items() if address}


def clear_buffer(calls: Calls, glo: int) -> None:
    """Fill a buffer with zeros on the device; moderngl writes them from the host."""
    calls["glBindBuffer"](_SHADER_STORAGE_BUFFER, glo)
    calls["glClearBufferData"](_SHADER_STORAGE_BUFFER, _R32UI, _RED_INTEGER, _UNSIGNED_INT, None)


def clear_texture(calls: Calls, glo: int) -> bool:
    """Fill a float texture with zeros on the device; False where OpenGL is too old for that."""
    if "glClearTexImage" in calls:
        calls["glClearTexImage"](glo, 0, _RGBA, _FLOAT, None)
    return "glClearTexImage" in calls
