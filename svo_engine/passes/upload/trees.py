# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled node trees on the device: a program for each structure, and the values of all materials."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from ...gpu.buffer import Buffer
from ...gpu.device import Device
from ...gpu.passes import Pass
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...nodes.compile import STYLED, Compiled, compile_materials
from ...nodes.moves import Moves, compile_moves
from ...scene.layouts import CONSTANTS
from ...scene.types import Image, Material, Scene

TEMPLATE = "evaluate/tree.comp.glsl"
STYLE = "evaluate/style.comp.glsl"
BUSY = 1 << 17  # invocations that keep a graphics card busy
GROUP = 64  # invocations of a workgroup
SHARE = 16  # slots of an invocation, where the processor renders
PLACE = "nodes/tree.glsl"  # the file of the template that a structure's text stands for


@dataclass(frozen=True, eq=False)
class Trees:
    """passes: the evaluating program of each compiled structure, by its number; styles: of those that go on with
    light as a colour the program that does; values: the buffer of bind/geo.glsl; moves: what moves vertices.
    """

    scope: GpuScope
    compiled: Compiled
    passes: Mapping[int, Pass]
    styles: Mapping[int, Pass]
    values: Buffer
    moves: Moves

    @property
    def variants(self) -> tuple[tuple[Pass, Mapping[str, bool]], ...]:
        """What a frame must have compiled."""
        movers = map(mover_pass, self.moves.structures)
        return tuple((pass_, {}) for pass_ in (*self.passes.values(), *self.styles.values(), *movers))

    @property
    def want_view(self) -> bool:
        """Whether any asks where the camera is."""
        return any("u_view_from_world" in pass_.wanted for pass_ in self.passes.values())

    @property
    def moves_want_view(self) -> bool:
        """Whether it matters for what moves vertices."""
        return any("u_view_from_world" in mover_pass(text).wanted for text in self.moves.structures)

    def told(self) -> list[str]:
        """A sentence for each thing in a tree that is not as in Blender."""
        return [f"Material '{name}': {note}" for name, note in self.compiled.notes]


def upload_trees(device: Device, materials: tuple[Material, ...], images: tuple[Image, ...]) -> Trees:
    """Compile the trees of those materials that have one of their own, and copy their values."""
    scope = device.scope()
    names = {image.name: i for i, image in reversed(list(enumerate(images)))}  # of tiles the first

    def find_image(name: Any) -> int:
        return names.get(name, len(images))

    compiled = compile_materials(materials, find_image)
    styles = {i: tree_pass(text, STYLE) for i, text in enumerate(compiled.structures) if f" {STYLED}(" in text}
    passes = {i: tree_pass(text) for i, text in enumerate(compiled.structures)}
    return Trees(scope, compiled, passes, styles, scope.buffer("values", compiled.values),
                 compile_moves(materials, find_image))


def with_stand_ins(device: Device, scene: Scene) -> Scene:
    """The same, but that plain values stand in where a tree's program is not compiled yet. Has the driver begin with
    those, if it has threads for that.
    """
    materials = scene.plain.materials
    compiled = compile_materials(materials, lambda _: 0)
    moves = compile_moves(materials, lambda _: 0)
    passes = [*map(tree_pass, compiled.structures), *map(mover_pass, moves.structures)]
    device.programs.begin((pass_, {}) for pass_ in passes)
    is_ready = [*(device.programs.find(pass_, {}) is not None for pass_ in passes), True]
    if all(is_ready):
        return scene
    movers = np.where(moves.structure_of < 0, -1, len(compiled.structures) + moves.structure_of)
    return replace(scene, materials=tuple(
        m if is_ready[structure] and is_ready[mover] else replace(m, is_exact=True)
        for m, structure, mover in zip(materials, compiled.structure_of, movers, strict=True)))


def evaluate_trees(device: Device, passes: Mapping[int, Pass], n: int, given: Resources) -> None:
    """Run a program for each of the structures of these numbers, over n slots. These are looked through by fewer
    invocations than there are, so that those that evaluate do it together.

    given  all that functions of shaders/nodes and the template can ask for, but u_step and u_program
    """
    n = GROUP * -(-n // (GROUP * SHARE)) if device.profiler.is_software else min(n, BUSY)
    for i, pass_ in passes.items():
        whole = {**given, "u_step": n, "u_program": CONSTANTS["PROGRAM_TREE"] + i}
        device.dispatch(pass_, n, **{name: whole[name] for name in pass_.wanted})


@lru_cache(1024)
def mover_pass(text: str) -> Pass:
    """The program of what moves vertices, as `tree_pass`."""
    return Pass("displace/vertices.comp.glsl", texts={"nodes/mover.glsl": text})


@lru_cache(1024)
def tree_pass(text: str, template: str = TEMPLATE) -> Pass:
    """The evaluating program of a structure; one object for each text, so that what is known of it stays."""
    return Pass(template, texts={PLACE: text})
