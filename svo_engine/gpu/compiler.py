# SPDX-License-Identifier: GPL-3.0-or-later
"""GLSL -> linked programs, several at once where the driver can, and with Python's lock free meanwhile.

What is compiled is kept on disk by the driver, NVIDIA's and Mesa's alike, so there is nothing for us to keep.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import ShaderError
from .calls import Calls, extensions
from .glsl import Source

_STAGES = {"comp": 0x91B9, "vert": 0x8B31, "frag": 0x8B30}
_COMPILE_STATUS, _LINK_STATUS, _INFO_LOG_LENGTH, _COMPLETION_STATUS = 0x8B81, 0x8B82, 0x8B84, 0x91B1
_AS_MANY_AS_IT_LIKES = 0xFFFFFFFF


@dataclass(eq=False)
class Job:
    """A program on its way. shaders: one for each of the sources."""

    sources: Sequence[Source]
    shaders: list[int]
    program: int


class Compiler:
    """is_parallel: whether the driver goes on by itself after `start`, which else returns when all is done."""

    def __init__(self, calls: Calls) -> None:
        self._calls = calls
        names = {f"GL_{owner}_parallel_shader_compile" for owner in ("KHR", "ARB")}
        self.is_parallel = bool(names & extensions(calls))
        if self.is_parallel and "glMaxShaderCompilerThreadsKHR" in calls:
            calls["glMaxShaderCompilerThreadsKHR"](_AS_MANY_AS_IT_LIKES)

    def start(self, sources: Sequence[Source]) -> Job:
        """Begin to compile and link; mistakes are told by `finish`."""
        calls = self._calls
        job = Job(sources, [], calls["glCreateProgram"]())
        for source in sources:
            shader, text = calls["glCreateShader"](_STAGES[source.path.split(".")[-2]]), source.text.encode()
            calls["glShaderSource"](shader, 1, (ctypes.c_char_p * 1)(text), (ctypes.c_int * 1)(len(text)))
            calls["glCompileShader"](shader)
            calls["glAttachShader"](job.program, shader)
            job.shaders.append(shader)
        calls["glLinkProgram"](job.program)
        return job

    def is_done(self, job: Job) -> bool:
        """Whether `finish` would not wait."""
        return not self.is_parallel or self._get("Program", job.program, _COMPLETION_STATUS) != 0

    def finish(self, job: Job) -> int:
        """OpenGL's name of the linked program; waits until it is there. ShaderError names the file and the line."""
        try:
            for source, shader in zip(job.sources, job.shaders, strict=True):
                if not self._get("Shader", shader, _COMPILE_STATUS):
                    raise ShaderError(source.explain(self._log("Shader", shader)))
            if not self._get("Program", job.program, _LINK_STATUS):
                raise ShaderError(job.sources[0].explain(self._log("Program", job.program)))
        except ShaderError:
            self.drop(job)
            raise
        self._drop_shaders(job)
        return job.program

    def drop(self, job: Job) -> None:
        """Give it up."""
        self._drop_shaders(job)
        self._calls["glDeleteProgram"](job.program)

    def _drop_shaders(self, job: Job) -> None:
        """Which a linked program does not need."""
        for shader in job.shaders:
            self._calls["glDeleteShader"](shader)

    def _get(self, kind: str, name: int, what: int) -> int:
        value = ctypes.c_int()
        self._calls[f"glGet{kind}iv"](name, what, ctypes.byref(value))
        return value.value

    def _log(self, kind: str, name: int) -> str:
        text = ctypes.create_string_buffer(max(self._get(kind, name, _INFO_LOG_LENGTH), 1))
        self._calls[f"glGet{kind}InfoLog"](name, len(text), None, text)
        return text.value.decode(errors="replace")
