# SPDX-License-Identifier: GPL-3.0-or-later
"""A pass as data: its shaders. What it reads and writes stands in them, and every call is checked against that."""

from __future__ import annotations

from collections.abc import Set as AbstractSet
from functools import cached_property

from . import glsl

RANGE = ("u_first", "u_end")  # uniforms that the device sets: the range of invocations of one slice


class Pass:
    """One NAME.comp.glsl, or NAME.vert.glsl and NAME.frag.glsl: paths below shaders/.

    name  `stage/entry`, as timings and counters call it
    """

    def __init__(self, *shaders: str) -> None:
        self.shaders = shaders
        self.name = shaders[0].split(".")[0]

    @cached_property
    def names(self) -> glsl.Names:
        """Names of storage blocks, samplers, images and uniforms, read from the shaders."""
        return glsl.names_of([glsl.compose(path) for path in self.shaders])

    def check(self, given: AbstractSet[str]) -> None:
        """Assert that a call gives just what the shaders declare."""
        declared = self._declared
        assert given == declared, f"{self.name}: missing {sorted(declared - given)}, unknown {sorted(given - declared)}"

    @cached_property
    def _declared(self) -> set[str]:
        names = self.names
        return {*names.buffers, *names.textures, *names.images, *names.uniforms} - {*RANGE}
