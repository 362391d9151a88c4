# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of OpenGL, called by ctypes, which decides for each whether Python's lock is free meanwhile.

While a function that may wait holds the lock, no other thread of Python goes on, and Blender's window stands still. But
to give the lock up for every small call would be worse: where another thread is busy, it comes back 5 ms later.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from typing import Any

from ..errors import GpuError

_U, _I, _P, _S = ctypes.c_uint, ctypes.c_int, ctypes.c_void_p, ctypes.c_ssize_t
_BOOL, _TEXT = ctypes.c_ubyte, ctypes.c_char_p

_QUICK: dict[str, tuple[Any, ...]] = {  # what it gives, what it takes
    "glGetError": (_U,),
    "glGetIntegerv": (None, _U, _P),
    "glGetStringi": (_TEXT, _U, _U),
    "glGenBuffers": (None, _I, _P),
    "glBindBuffer": (None, _U, _U),
    "glBindBufferBase": (None, _U, _U, _U),
    "glGenTextures": (None, _I, _P),
    "glActiveTexture": (None, _U),
    "glBindTexture": (None, _U, _U),
    "glTexParameteri": (None, _U, _U, _I),
    "glTexBuffer": (None, _U, _U, _U),
    "glBindImageTexture": (None, _U, _U, _I, _BOOL, _I, _U, _U),
    "glPixelStorei": (None, _U, _I),
    "glGenFramebuffers": (None, _I, _P),
    "glBindFramebuffer": (None, _U, _U),
    "glFramebufferTexture2D": (None, _U, _U, _U, _U, _I),
    "glFramebufferRenderbuffer": (None, _U, _U, _U, _U),
    "glDeleteFramebuffers": (None, _I, _P),
    "glGenRenderbuffers": (None, _I, _P),
    "glBindRenderbuffer": (None, _U, _U),
    "glRenderbufferStorage": (None, _U, _U, _I, _I),
    "glDeleteRenderbuffers": (None, _I, _P),
    "glViewport": (None, _I, _I, _I, _I),
    "glEnable": (None, _U),
    "glGenVertexArrays": (None, _I, _P),
    "glBindVertexArray": (None, _U),
    "glGenQueries": (None, _I, _P),
    "glBeginQuery": (None, _U, _U),
    "glEndQuery": (None, _U),
    "glDeleteQueries": (None, _I, _P),
    "glMaxShaderCompilerThreadsKHR": (None, _U),
    "glCreateShader": (_U, _U),
    "glShaderSource": (None, _U, _I, _P, _P),
    "glAttachShader": (None, _U, _U),
    "glDeleteShader": (None, _U),
    "glCreateProgram": (_U,),
    "glUseProgram": (None, _U),
    "glMemoryBarrier": (None, _U),
    "glGetProgramResourceIndex": (_U, _U, _U, _TEXT),
    "glShaderStorageBlockBinding": (None, _U, _U, _U),
    "glGetUniformLocation": (_I, _U, _TEXT),
    **{f"glProgramUniform{n}{kind}v": (None, _U, _I, _I, _P) for n in "1234" for kind in ("f", "i", "ui")},
    **{f"glProgramUniformMatrix{n}fv": (None, _U, _I, _I, _BOOL, _P) for n in "34"},
}
_MAY_WAIT: dict[str, tuple[Any, ...]] = {  # for the device, for the compiler, or for the processor to copy
    "glFinish": (None,),
    "glBufferData": (None, _U, _S, _P, _U),
    "glBufferSubData": (None, _U, _S, _S, _P),
    "glGetBufferSubData": (None, _U, _S, _S, _P),
    "glMapBufferRange": (_P, _U, _S, _S, _U),
    "glUnmapBuffer": (_BOOL, _U),
    "glDeleteBuffers": (None, _I, _P),
    "glTexImage2D": (None, _U, _I, _I, _I, _I, _I, _U, _U, _P),
    "glTexImage3D": (None, _U, _I, _I, _I, _I, _I, _I, _U, _U, _P),
    "glTexStorage3D": (None, _U, _I, _U, _I, _I, _I),
    "glTexSubImage2D": (None, _U, _I, _I, _I, _I, _I, _U, _U, _P),
    "glTexSubImage3D": (None, _U, _I, _I, _I, _I, _I, _I, _I, _U, _U, _P),
    "glGetTexImage": (None, _U, _I, _U, _U, _P),
    "glGenerateMipmap": (None, _U),
    "glDeleteTextures": (None, _I, _P),
    "glGetQueryObjectui64v": (None, _U, _U, _P),
    "glCompileShader": (None, _U),
    "glGetShaderiv": (None, _U, _U, _P),
    "glGetShaderInfoLog": (None, _U, _I, _P, _P),
    "glLinkProgram": (None, _U),
    "glGetProgramiv": (None, _U, _U, _P),
    "glGetProgramInfoLog": (None, _U, _I, _P, _P),
    "glDeleteProgram": (None, _U),
}
_WORK: dict[str, tuple[Any, ...]] = {  # done at once by a software renderer, and put off by a graphics card
    "glDispatchCompute": (None, _U, _U, _U),
    "glDrawArraysInstanced": (None, _U, _I, _I, _I),
    "glFlush": (None,),
    "glClearBufferSubData": (None, _U, _U, _S, _S, _U, _U, _P),
    "glClearTexImage": (None, _U, _I, _U, _U, _P),
    "glCopyBufferSubData": (None, _U, _U, _S, _S, _S),
    "glClearBufferfv": (None, _U, _I, _P),
    "glClearBufferuiv": (None, _U, _I, _P),
}

Calls = dict[str, Callable[..., Any]]

RENDERER, EXTENSIONS, N_EXTENSIONS = 0x1F01, 0x1F03, 0x821D
_OUT_OF_MEMORY = 0x0505

_FREES_THE_LOCK = getattr(ctypes, "WINFUNCTYPE" if sys.platform == "win32" else "CFUNCTYPE")


def load_calls(loader: Any) -> Calls:
    """The functions of the current context, without those that it lacks: some are newer than OpenGL 4.3."""
    calls: Calls = {"glGetString": _FREES_THE_LOCK(_TEXT, _U)(loader.load_opengl_function("glGetString"))}
    work = _FREES_THE_LOCK if is_software(calls) else ctypes.PYFUNCTYPE
    for prototype, signatures in ((ctypes.PYFUNCTYPE, _QUICK), (_FREES_THE_LOCK, _MAY_WAIT), (work, _WORK)):
        for name, signature in signatures.items():
            if address := loader.load_opengl_function(name):
                calls[name] = prototype(*signature)(address)
    return calls


def string(calls: Calls, name: int) -> str:
    """What the driver says of itself."""
    return (calls["glGetString"](name) or b"").decode(errors="replace")


def is_software(calls: Calls) -> bool:
    """Whether the processor draws: Mesa's software renderer."""
    return "llvmpipe" in string(calls, RENDERER)


def integer(calls: Calls, name: int) -> int:
    """A limit or a state; 0 where the driver does not know it."""
    value = _I()
    calls["glGetIntegerv"](name, ctypes.byref(value))
    return value.value


def extensions(calls: Calls) -> frozenset[str]:
    """What the driver can do beyond OpenGL 4.3."""
    return frozenset(calls["glGetStringi"](EXTENSIONS, i).decode() for i in range(integer(calls, N_EXTENSIONS)))


def generate(calls: Calls, kind: str) -> int:
    """A new name for an object: kind Buffers, Textures ..."""
    name = _U()
    calls[f"glGen{kind}"](1, ctypes.byref(name))
    return name.value


def delete(calls: Calls, kind: str, name: int) -> None:
    """Give an object and its name back."""
    calls[f"glDelete{kind}"](1, ctypes.byref(_U(name)))


def check_memory(calls: Calls) -> None:
    """GpuError if the device had no room for what was asked of it since the last check."""
    while error := calls["glGetError"]():
        if error == _OUT_OF_MEMORY:
            raise GpuError("out of memory")
