# SPDX-License-Identifier: GPL-3.0-or-later
"""A pass as data: its shaders. What it reads and writes stands in them, and every call is checked against that."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from functools import cached_property

from . import glsl

RANGE = ("u_first", "u_end")  # uniforms that the device sets: the range of invocations of one slice


class Pass:
    """One NAME.comp.glsl, or NAME.vert.glsl and NAME.frag.glsl: paths below shaders/.

    name   `stage/entry`, as timings and counters call it
    texts  what stands for files that they include: such as a compiled tree
    """

    def __init__(self, *shaders: str, texts: Mapping[str, str] | None = None) -> None:
        self.shaders = shaders
        self.texts = texts or {}
        self.name = shaders[0].split(".")[0]
        self.key = (*shaders, *(f"{file}\0{text}" for file, text in self.texts.items()))

    @cached_property
    def names(self) -> glsl.Names:
        """Names of storage blocks, samplers, images and uniforms, read from the shaders."""
        return glsl.names_of([glsl.compose(path, texts=self.texts) for path in self.shaders])

    def check(self, given: AbstractSet[str]) -> None:
        """Assert that a call gives just what the shaders declare."""
        declared = self.wanted
        assert given == declared, f"{self.name}: missing {sorted(declared - given)}, unknown {sorted(given - declared)}"

    @cached_property
    def wanted(self) -> frozenset[str]:
        """All that a call must give."""
        names = self.names
        return frozenset({*names.buffers, *names.textures, *names.images, *names.uniforms} - {*RANGE})
