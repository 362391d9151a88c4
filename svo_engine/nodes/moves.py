# SPDX-License-Identifier: GPL-3.0-or-later
"""How materials move the vertices of what shows them: texts, and the values of each material.

Apart from what surfaces look like, so that an edit of a colour moves nothing anew.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..scene.graph import Graph
from ..scene.types import Material
from .build import Built
from .compile import MOST_REMEMBERED
from .displacement import method_of, move_of
from .emit import Datum, Writer
from .expr import Call, Constant, Expr, Literal, children

# What is the same wherever the object stands, among functions that look at the point
_OF_OBJECT = {"generated_of_point", "position_in_object", "normal_in_object", "attribute_vector", "attribute_factor",
              "attribute_alpha", "attribute_component", "attribute_number", "color_attribute_alpha", "object_color",
              "object_alpha", "object_random", "object_number", "material_number", "generated_of_instancer",
              "uv_of_instancer", "parametric_of_point", "displaced_in_tangent_space"}


@dataclass(frozen=True, eq=False)
class Moves:
    """structures   texts that define `displacement(Geo g)`: metres in world space
    structure_of  (n_materials,) i4: the structure of each material, -1 for one that moves nothing
    first_value   (n_materials,) u4: where its values begin among `values`, u4; the same for materials that are alike
    attributes    names of the attributes that they ask for, by number
    images        indices of the images that they read
    bumps         (n_materials,) bool: whether normals stay, because a bump turns them
    is_placed     (n_materials,) bool: whether it matters where the object stands
    """

    structures: tuple[str, ...]
    structure_of: np.ndarray
    first_value: np.ndarray
    values: np.ndarray
    attributes: tuple[Hashable, ...]
    images: tuple[int, ...]
    bumps: np.ndarray
    is_placed: np.ndarray


@dataclass(frozen=True, eq=False)
class _One:
    text: str
    data: tuple[Datum, ...]
    is_placed: bool


def compile_moves(materials: Sequence[Material], find_image: Callable[[Any], int]) -> Moves:
    """Compile what moves vertices in the trees of those materials that the plain table does not say all of.

    find_image  as for `compile_materials`
    """
    texts: dict[str, int] = {}
    attributes: dict[Hashable, int] = {}
    images: set[int] = set()
    known: dict[tuple[str, bytes], int] = {}
    words, n_values = [np.zeros(0, "u4")], 0
    structure_of, first_value = np.full(len(materials), -1, "i4"), np.zeros(len(materials), "u4")
    bumps, is_placed = np.zeros(len(materials), bool), np.zeros(len(materials), bool)

    def index(what: str, name: Any) -> int:
        if what != "image":
            return attributes.setdefault(name, len(attributes))
        images.add(number := find_image(name))
        return number

    for i, material in enumerate(materials):
        one = None if material.is_exact or material.graph is None else _moves_of(material.graph)
        if one is None or material.graph is None:
            continue
        own = np.concatenate([np.zeros(0, "u4"), *(datum.words(index) for datum in one.data)])
        structure_of[i] = texts.setdefault(one.text, len(texts))
        first_value[i] = known.setdefault((one.text, own.tobytes()), n_values)
        if first_value[i] == n_values:
            words.append(own)
            n_values += len(own)
        bumps[i], is_placed[i] = method_of(material.graph) == "BOTH", one.is_placed
    return Moves(tuple(texts), structure_of, first_value, np.concatenate(words), tuple(attributes),
                 tuple(sorted(images)), bumps, is_placed)


_remembered: dict[int, tuple[Graph, _One | None]] = {}


def _moves_of(graph: Graph) -> _One | None:
    """Of a tree; remembered for as long as the Graph is the same object."""
    known = _remembered.get(id(graph))
    if known is None or known[0] is not graph:
        while len(_remembered) >= MOST_REMEMBERED:
            _remembered.pop(next(iter(_remembered)))
        known = _remembered[id(graph)] = graph, _compile(graph)
    return known[1]


def _compile(graph: Graph) -> _One | None:
    """What is not as in Blender is told with the surface."""
    if graph.displacement is None or method_of(graph) == "BUMP":
        return None
    by = move_of(graph, Built(graph, {"displacement": graph.displacement}, lambda _: None))
    if by is None:
        return None
    writer = Writer()
    writer.value("vec3 displacement(Geo g)", by)
    return _One(writer.text(), tuple(writer.data), _is_placed(by))


def _is_placed(root: Expr) -> bool:
    """Whether the move as the object sees it can be another one where that stands elsewhere."""
    if isinstance(root, Constant):
        return True
    seen: set[int] = set()
    waiting = [root]
    while waiting:
        expr = waiting.pop()
        if id(expr) in seen:
            continue
        seen.add(id(expr))
        parts = list(children(expr))
        if isinstance(expr, Call) and expr.signature.takes_geo:
            name = expr.signature.name
            if name in ("displaced", "displaced_by_vector"):
                if not _is_true(expr.arguments[-1]):
                    return True
                parts = [p for p in parts if not (name == "displaced" and _is_own_normal(p))]
            elif name not in _OF_OBJECT:
                return True
        waiting += parts
    return False


def _is_true(expr: Expr) -> bool:
    return isinstance(expr, Literal) and bool(expr.value[0])


def _is_own_normal(expr: Expr) -> bool:
    """Through what only says what it is meant as."""
    while not isinstance(expr, Call) and children(expr):
        (expr,) = children(expr)
    return isinstance(expr, Call) and expr.signature.name == "normal_of_point"
