# SPDX-License-Identifier: GPL-3.0-or-later
"""A pass as data: its shaders and the names of all that it reads and writes; every call is checked against it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property


@dataclass(frozen=True)
class Pass:
    """Names as they stand in the shaders: storage blocks, samplers, images and plain uniforms.

    shaders  one NAME.comp.glsl, or NAME.vert.glsl and NAME.frag.glsl; paths below shaders/
    """

    shaders: tuple[str, ...]
    buffers: tuple[str, ...] = ()
    textures: tuple[str, ...] = ()
    images: tuple[str, ...] = ()
    uniforms: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """`stage/entry`, as timings and counters call it."""
        return self.shaders[0].split(".")[0]

    def check(self, given: set[str]) -> None:
        """Assert that a call gives just what is declared."""
        declared = self._declared
        assert given == declared, f"{self.name}: missing {sorted(declared - given)}, unknown {sorted(given - declared)}"

    @cached_property
    def _declared(self) -> set[str]:
        return {*self.buffers, *self.textures, *self.images, *self.uniforms}
