# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures by themselves: their outputs at given points, by the compiled kind of the node and by Cycles.

Both are given the same points to the last bit. In Blender they are made of UVs that are snapped to a grid of powers of
two, so that it does not matter where in a pixel Cycles looks.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from svo_engine.nodes.emit import Writer
from svo_engine.nodes.expr import Call, Expr, converted
from svo_engine.nodes.kinds import kinds
from svo_engine.nodes.reader import Reader
from svo_engine.nodes.signatures import Signature
from svo_engine.scene.graph import Node
from tests import compute

SIZE = 32  # points of a card's side

# at = (i, j, 0) / SIZE * SPREAD + z + MOVED, z = (i, j) . RISE; w = (i, j) . W_RISE + W_MOVED
SPREAD, RISE, MOVED = (4.0, 3.0, 0.0), (0.5, 1.25, 0.0), (-1.5, -0.75, 0.375)
W_RISE, W_MOVED = (2.5, 1.5, 0.0), -1.25

# Of the compiled text nothing is known of the scene but the point and the values
STUB = """
struct Geo { vec3 at; float w; uint which; };
layout(std430) readonly buffer Values { uint values[]; };
float value_at(Geo g, uint i) { return uintBitsToFloat(values[i]); }
vec3 value3_at(Geo g, uint i) { return vec3(value_at(g, i), value_at(g, i + 1u), value_at(g, i + 2u)); }
vec3 at_of(Geo g) { return g.at; }
float w_of(Geo g) { return g.w; }
"""


@dataclass(frozen=True)
class Case:
    """One texture: the outputs to look at, and what of the node's settings and inputs is not as in a new node."""

    kind: str
    outputs: tuple[str, ...]
    settings: Mapping[str, Any] = field(default_factory=dict)
    inputs: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Of the case among others."""
        parts = [self.kind.removeprefix("ShaderNodeTex"), *map(str, self.settings.values()),
                 *(f"{k}={v}" for k, v in self.inputs.items())]
        return " ".join(parts)


def points() -> tuple[np.ndarray, np.ndarray]:
    """at  (SIZE^2, 3) f4 and w (SIZE^2,) f4: the points of a card, rows from the bottom up."""
    j, i = np.mgrid[0:SIZE, 0:SIZE].astype("f4") / np.float32(SIZE)
    z = i * RISE[0] + j * RISE[1]
    at = np.stack([i * SPREAD[0], j * SPREAD[1], z], -1).astype("f4") + np.array(MOVED, "f4")
    return at.reshape(-1, 3), (i * W_RISE[0] + j * W_RISE[1] + W_MOVED).astype("f4").ravel()


def text_of(node: Node, outputs: Sequence[str], warn: Any = lambda sentence: None) -> tuple[str, np.ndarray]:
    """The function `shown(Geo g)` that gives the outputs of a node at a point, and its values (n,) u4."""
    linked = {"Vector": _given("vec3", "at_of"), "W": _given("float", "w_of")}
    reader = Reader(node, lambda name: linked.get(name, node.inputs.get(name)), linked.__contains__,
                    outputs.__contains__, warn)
    made = kinds()[node.kind](reader)
    shown = [converted(made[name], "vec3") for name in outputs]  # type: ignore[arg-type]
    writer = Writer()
    writer.function("vec3 shown(Geo g)", shown, lambda code: [
        *(f"if (g.which == {i}u) return {code(expr)};" for i, expr in enumerate(shown)), "return vec3(0.0);"])
    return writer.text(), np.concatenate([np.zeros(0, "u4"), *(datum.words(None) for datum in writer.data)])


def by_us(device: Any, node: Node, outputs: Sequence[str]) -> np.ndarray:
    """(outputs, SIZE^2, 3) f4"""
    text, values = text_of(node, outputs)
    lines = text.splitlines()
    includes = [line.split('"')[1] for line in lines if line.startswith("#include")]
    body = "\n".join(line for line in lines if not line.startswith("#include"))
    at, w = points()
    which = np.repeat(np.arange(len(outputs), dtype="u4"), len(w))
    found = compute.evaluate(device, "vec3", "shown(Geo(at, w, which))", includes, STUB + body,
                             buffers={"Values": np.append(values, np.uint32(0))}, which=which,
                             at=np.tile(at, (len(outputs), 1)), w=np.tile(w, len(outputs)))
    return found.reshape(len(outputs), -1, 3)


def _given(type_: str, function: str) -> Expr:
    return Call(type_, Signature(function, "nodes/convert.glsl", type_, (), (), (), takes_geo=True), ())


def by_cycles(cases: Sequence[Case]) -> tuple[list[np.ndarray], list[Node]]:
    """Of each case (outputs, SIZE^2, 3) f4, and its node as it is read from Blender. All in one picture of cards."""
    import bpy

    from tests.blender import build, cycles

    bpy.ops.wm.read_factory_settings(use_empty=True)
    shown, nodes = [], []
    for case in cases:
        for i, output in enumerate(case.outputs):
            tree = build.material(case.name)
            made = _node(tree, case)
            shown.append(tree.show(tree.new("Emission", Color=_socket(made.outputs, output))))
            if i == 0:
                nodes.append(_read(made))
    side = math.ceil(math.sqrt(len(shown)))
    for i, material in enumerate(shown):
        build.plane(material, at=(2 * (i % side), 2 * (i // side), 0))
    camera = cycles.look_down(2 * side, 4)
    camera.location.x = camera.location.y = side - 1
    with tempfile.TemporaryDirectory() as folder:
        picture = cycles.render(Path(folder), size=(SIZE * side,) * 2, samples=1, filter_width=0.01)[..., :3]
    cards = picture.reshape(side, SIZE, side, SIZE, 3).swapaxes(1, 2).reshape(-1, SIZE * SIZE, 3)[:len(shown)]
    ends = np.cumsum([len(case.outputs) for case in cases])
    return np.split(cards, ends[:-1]), nodes


def _node(tree: Any, case: Case) -> Any:
    """The node of a case, with what is linked to it."""
    node = tree.tree.nodes.new(case.kind)
    for name, value in case.settings.items():
        owner, _, part = name.rpartition(".")
        setattr(getattr(node, owner) if owner else node, part, value)
    for name, value in case.inputs.items():
        tree.set(node, name, value)
    linked = dict(zip(("Vector", "W"), _grid(tree), strict=True))
    for socket in node.inputs:
        if not socket.is_unavailable and socket.identifier in linked:
            tree.set(node, socket.identifier, linked[socket.identifier])
    return node


def _grid(tree: Any) -> tuple[Any, Any]:
    """Sockets of `at` and `w`, in the order of the sums in `points`."""
    snapped = _math(tree, "SNAP", tree.tree.nodes.new("ShaderNodeUVMap").outputs[0], (1 / SIZE,) * 3)
    z = tree.new("CombineXYZ", Z=_math(tree, "DOT_PRODUCT", snapped, RISE))
    flat = _math(tree, "ADD", _math(tree, "MULTIPLY", snapped, SPREAD), z.outputs[0])
    w = tree.tree.nodes.new("ShaderNodeMath")
    tree.set(w, "Value", _math(tree, "DOT_PRODUCT", snapped, W_RISE))
    tree.set(w, "Value_001", W_MOVED)
    return _math(tree, "ADD", flat, MOVED), w.outputs[0]


def _math(tree: Any, operation: str, a: Any, b: Any) -> Any:
    node = tree.tree.nodes.new("ShaderNodeVectorMath")
    node.operation = operation
    tree.set(node, "Vector", a)
    tree.set(node, "Vector_001", b)
    return node.outputs["Value" if operation == "DOT_PRODUCT" else "Vector"]


def _socket(sockets: Any, identifier: str) -> Any:
    return next(s for s in sockets if s.identifier == identifier)


def _read(node: Any) -> Node:
    """The node as a Graph has it, but for links."""
    from svo_engine.blender.extract.graphs import _inputs
    from svo_engine.blender.extract.node_settings import settings_of_node

    return Node(node.bl_idname, settings_of_node(node, {}), _inputs(node, {}, {}), node.name)
