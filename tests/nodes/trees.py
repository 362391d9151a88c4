# SPDX-License-Identifier: GPL-3.0-or-later
"""Many trees at once, without a frame around them: compiled into one compute program, and one picture by Cycles.

A tree is given texture coordinates alone. Cycles is asked for those of its samples as well, so that both sides compute
with the same numbers and functions that jump may be compared.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from svo_engine.nodes.build import Built
from svo_engine.nodes.closures import Leaf
from svo_engine.nodes.emit import Writer
from svo_engine.nodes.expr import as_vector
from svo_engine.nodes.kinds import kinds
from svo_engine.render import Session
from svo_engine.scene.graph import Graph
from tests.blender import build, cycles
from tests.blender.build import extracted
from tests.compute import evaluate

SIZE = 16  # pixels of a card's side

# Makes nodes in the tree of `build.Nodes` and gives the socket or node to look at
Maker = Callable[[build.Nodes], Any]

# Of the cards, as `cycles.look_down` sees them from 2 m above its near plane's 2 cm
POINT = """
Geo point_of(vec2 uv)
{
    Geo g;
    g.position = vec3(uv, 0.0);
    g.normal = g.normal_geometric = g.wo = vec3(0.0, 0.0, 1.0);
    g.bary = vec2(0.3, 0.4);
    g.dx = g.dy = vec2(0.0);
    g.t = 1.98;
    g.instance = g.triangle = g.rays = g.depth = g.first_value = 0u;
    g.is_back = false;
    return g;
}
"""


def make_cards(makers: Sequence[Maker]) -> None:
    """A new file with a card for each maker, left to right and bottom to top in a square, seen from 2 m above."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    side = math.ceil(math.sqrt(len(makers)))
    for i, maker in enumerate(makers):
        nodes = build.material(f"Card {i:04}")
        shown = maker(nodes)
        nodes.show(shown if shown.bl_idname == "NodeSocketShader" else nodes.new("Emission", Color=shown))
        if hasattr(nodes.owner, "cycles"):
            nodes.owner.cycles.emission_sampling = "NONE"
        build.plane(nodes.owner, name=f"Card {i:04}", at=(2 * (i % side), 2 * (i // side), 0))
    camera = cycles.look_down(2 * side, 2)
    camera.location.x = camera.location.y = side - 1


def by_cycles(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Of the open file, the colours and the texture coordinates of all samples: (n, SIZE, SIZE, 3 and 2) f4."""
    side = math.ceil(math.sqrt(n))
    coordinates = build.material("Coordinates")
    coordinates.show(coordinates.new("Emission", Color=coordinates.new("TexCoord").outputs["UV"]))
    layer = bpy.context.view_layer
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for material in (None, coordinates.owner):
            layer.material_override = material
            picture = cycles.render(Path(folder), size=(side * SIZE, side * SIZE), samples=1, filter_width=0.01)
            cards = picture[..., :3].reshape(side, SIZE, side, SIZE, 3).swapaxes(1, 2).reshape(-1, SIZE, SIZE, 3)[:n]
            found.append(cards)
    layer.material_override = None
    return found[0], found[1][..., :2]


def graphs() -> list[Graph]:
    """The trees of the cards of the open file."""
    made = {m.name: m.graph for m in extracted().materials}
    found = [made[name] for name in sorted(made) if name.startswith("Card")]
    assert all(found)
    return [graph for graph in found if graph]


@contextmanager
def coordinates_of_points() -> Iterator[None]:
    """Let Texture Coordinate nodes read what `point_of` has put into the position."""
    known: Any = kinds()
    before = known.get("ShaderNodeTexCoord")
    known["ShaderNodeTexCoord"] = lambda n: {"UV": as_vector(n.call("position_of_point"))}
    try:
        yield
    finally:
        known.pop("ShaderNodeTexCoord")
        if before:
            known["ShaderNodeTexCoord"] = before


def compiled(trees: Sequence[Graph]) -> tuple[str, np.ndarray, list[str]]:
    """GLSL of \"vec3 tree(uint number, Geo g)\", the words of its values, and what was told."""
    writer, notes = Writer(), dict[str, None]()
    with coordinates_of_points():
        for i, graph in enumerate(trees):
            shown = Built(graph, {"surface": graph.surface}, notes.setdefault).shader("surface")
            assert isinstance(shown, Leaf)
            writer.value(f"vec3 tree_{i}(Geo g)", shown.arguments[0])
    # One after another: software renderers give up on a switch of more than 80 cases, and on ifs in as many ifs
    cases = "\n".join(f"    if (i == {i}u)\n        made = tree_{i}(g);" for i in range(len(trees)))
    text = (f"{writer.text()}{POINT}\nvec3 tree(uint i, Geo g)\n{{\n    vec3 made = vec3(0.0);\n{cases}\n"
            "    return made;\n}")
    words = np.concatenate([np.zeros(1, "u4"), *(datum.words(lambda what, name: 0) for datum in writer.data)])
    return text, words[1:], list(notes)


def by_us(session: Session, trees: Sequence[Graph], uv: np.ndarray) -> np.ndarray:
    """The trees at texture coordinates (n, SIZE, SIZE, 2): (n, SIZE, SIZE, 3) f4."""
    text, words, _ = compiled(trees)
    number = np.repeat(np.arange(len(trees), dtype="u4"), SIZE * SIZE)
    made = session.opened().thread.call(lambda device: evaluate(
        device, "vec3", "tree(number, point_of(uv))", ("nodes/point.glsl",), text,
        buffers={"Values": np.append(words, np.zeros(1, "u4"))}, number=number, uv=uv.reshape(-1, 2)))
    return made.reshape(*uv.shape[:-1], 3)


def compare(session: Session, makers: Sequence[Maker]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The trees by us and by Cycles, and the worst error of each as a share of the range of its values, at least 1."""
    make_cards(makers)
    trees = graphs()
    theirs, uv = by_cycles(len(makers))
    ours = by_us(session, trees, uv)
    span = np.maximum(np.ptp(theirs.reshape(len(makers), -1), axis=1), 1.0)
    return ours, theirs, np.abs(ours - theirs).reshape(len(makers), -1).max(1) / span
