# SPDX-License-Identifier: GPL-3.0-or-later
"""The trees of the world and of lamps: constants where they fold, else text and values, as for materials."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..scene.graph import Graph
from ..scene.types import Color, Light, Scene, World
from .build import Built
from .closures import Leaf, Weighted, leaves
from .compile import One
from .emit import Writer
from .expr import Constant, Expr, Literal
from .rays import CAMERA, LAMP, LIGHT, Falloff, asks_for_rays, of_lamp, seen_by, without_falloff
from .traits import traits_of

MOST_REMEMBERED = 256

# Functions of shaders/nodes that ask for the camera
OF_VIEW = ("position_in_window", "position_in_camera", "view_vector", "view_depth", "view_distance")


@dataclass(frozen=True, eq=False)
class Shine:
    """What a tree sends out. color: that, if it is the same everywhere; else `tree` says it."""

    color: Color | None
    tree: One
    notes: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class WorldTrees:
    """light: what lights the scene; seen: what the camera sees, the same object if no node tells them apart."""

    light: Shine
    seen: Shine


@dataclass(frozen=True, eq=False)
class LampTree:
    """shine: at the lamp itself; falloff: what becomes of it on its way."""

    shine: Shine
    falloff: Falloff


def settled(scene: Scene) -> Scene:
    """The scene with the values of those trees of world and lamps that say the same everywhere."""
    if scene.world.is_exact and all(light.is_exact for light in scene.lights):
        return scene
    return replace(scene, world=_settled_world(scene.world), lights=tuple(map(_settled_lamp, scene.lights)))


def told(scene: Scene) -> list[str]:
    """A sentence for each thing in the trees of world and lamps that is not as in Blender."""
    found: dict[str, None] = {}
    if not scene.world.is_exact and scene.world.graph:
        trees = world_trees(scene.world.graph)
        found.update(dict.fromkeys(f"World: {note}" for note in (*trees.light.notes, *trees.seen.notes)))
    for light in scene.lights:
        if not light.is_exact and light.graph:
            found.update(dict.fromkeys(f"Light '{light.name}': {n}" for n in lamp_tree(light.graph).shine.notes))
    return list(found)


def wants_view(graph: Graph) -> bool:
    """Whether a world looks another way when the camera is turned."""
    trees = world_trees(graph)
    return any(f"{name}(" in shine.tree.text for name in OF_VIEW for shine in (trees.light, trees.seen))


def world_trees(graph: Graph) -> WorldTrees:
    """The trees of a world."""
    made: WorldTrees = _remembered("world", graph, _world_trees)
    return made


def lamp_tree(graph: Graph) -> LampTree:
    """The tree of a lamp."""
    made: LampTree = _remembered("lamp", graph, _lamp_tree)
    return made


def _settled_world(world: World) -> World:
    if world.is_exact or world.graph is None:
        return world
    trees = world_trees(world.graph)
    if trees.light.color is None or trees.seen is not trees.light:
        return World(trees.light.color or (1.0, 1.0, 1.0), graph=world.graph, is_exact=False)
    return World(trees.light.color)


def _settled_lamp(light: Light) -> Light:
    if light.is_exact or light.graph is None:
        return light
    tree = lamp_tree(light.graph)
    way: dict[str, Any] = {"falloff": tree.falloff.falloff, "smoothing": tree.falloff.smoothing}
    if light.kind == "SUN":  # which is nowhere near
        way = {}
    if tree.shine.color is None:
        return replace(light, **way)
    r, g, b = (a * b for a, b in zip(light.emitted, tree.shine.color, strict=True))
    return replace(light, emitted=(r, g, b), is_exact=True, graph=None, **way)


def _world_trees(graph: Graph) -> WorldTrees:
    light = _shine(seen_by(graph, LIGHT))
    if not asks_for_rays(graph):
        return WorldTrees(light, light)
    seen = _shine(seen_by(graph, CAMERA))
    same = light.color == seen.color if light.color and seen.color else False
    return WorldTrees(light, light if same else seen)


def _lamp_tree(graph: Graph) -> LampTree:
    notes: dict[str, None] = {}
    straight, falloff = without_falloff(graph, notes.setdefault)
    shine = _shine(of_lamp(seen_by(straight, LAMP)))
    return LampTree(replace(shine, notes=(*notes, *shine.notes)), falloff)


def _shine(graph: Graph) -> Shine:
    notes: dict[str, None] = {}
    found = [w for w in leaves(Built(graph, {"surface": graph.surface}, notes.setdefault).shader("surface"))
             if w.leaf.name == "closure_emission" and not _is_nothing(w.weight)]
    writer = Writer()
    writer.closures(found)
    tree = One(writer.text(), tuple(writer.data), writer.n_values, traits_of(found), tuple(notes))
    return Shine(_constant(found), tree, tuple(notes))


def _is_nothing(weight: Expr) -> bool:
    return isinstance(weight, (Constant, Literal)) and weight.value == (0.0,)


def _constant(found: list[Weighted]) -> Color | None:
    """The sum of all, if each is known."""
    total = np.zeros(3)
    for weighted in found:
        leaf: Leaf = weighted.leaf
        parts: list[Expr] = [weighted.weight, *leaf.arguments]
        if not all(isinstance(part, (Constant, Literal)) for part in parts):
            return None
        weight, color, strength = (np.array(part.value) for part in parts if isinstance(part, (Constant, Literal)))
        total = total + weight * strength * color
    r, g, b = total.tolist()
    return r, g, b


_known: dict[tuple[str, int], tuple[Graph, Any]] = {}


def _remembered(what: str, graph: Graph, make: Callable[[Graph], Any]) -> Any:
    """make(graph), remembered for as long as the Graph is the same object."""
    key = what, id(graph)
    known = _known.get(key)
    if known is None or known[0] is not graph:
        while len(_known) >= MOST_REMEMBERED:
            _known.pop(next(iter(_known)))
        known = _known[key] = graph, make(graph)
    return known[1]


def values_of(tree: One, find_image: Callable[[Any], int]) -> tuple[np.ndarray, frozenset[int]]:
    """The values (n,) u4 of a tree by itself, and the images that it reads. Attributes are none: a ray that leaves the
    scene meets no mesh.
    """
    images: set[int] = set()

    def index(what: str, name: Any) -> int:
        if what != "image":
            return 0
        images.add(number := find_image(name))
        return number

    words: Mapping[int, np.ndarray] = {datum.first: datum.words(index) for datum in tree.data}
    return np.concatenate([np.zeros(0, "u4"), *words.values()]), frozenset(images)
