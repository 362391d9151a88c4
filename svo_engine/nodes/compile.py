# SPDX-License-Identifier: GPL-3.0-or-later
"""All materials of a scene -> structures, each a text of GLSL, and the values of each material.

Materials that differ in values alone share a structure, and so a program.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..scene.graph import Graph
from ..scene.types import Material
from .build import Built
from .closures import leaves
from .displacement import method_of, move_of, normal_of
from .emit import Datum, Writer
from .traits import Traits, traits_of

MOST_REMEMBERED = 1024
STYLED = "styled"  # the function of a structure that goes on with light as a colour

# Light that was spread sees the colours that full light gives, and no light of their own
_SURFACE_OF_STYLED = """void surface(Geo g, inout Closures c)
{
    lit(g, c);
    if (!c.wants_mean)
        return;
    lit_light = c.mean + c.emission;
    Closures s = no_closures(g, c.chance, true);
    styled(g, s);
    c = s;
    c.mean += c.emission;
    c.emission = vec3(0.0);
}
"""


@dataclass(frozen=True, eq=False)
class Compiled:
    """structures   texts that define `surface(Geo g, inout Closures c)`
    structure_of  (n_materials,) i4: the structure of each material, -1 for one without a tree of its own
    first_value   (n_materials,) u4: where its values begin among `values`, u4: bits of floats, and indices
    movers        texts that define `displacement(Geo g)`; mover_of and first_moving as structure_of and first_value;
                  keeps_normals: (n_materials,) bool, whether the surface is bumped as well
    attributes    names of the attributes that trees ask for, by number
    images        indices of the images that trees read
    traits        of each material what its tree can do; None for one without a tree of its own
    notes         (material, sentence): what is not as in Blender
    """

    structures: tuple[str, ...]
    structure_of: np.ndarray
    first_value: np.ndarray
    values: np.ndarray
    movers: tuple[str, ...]
    mover_of: np.ndarray
    first_moving: np.ndarray
    keeps_normals: np.ndarray
    attributes: tuple[Hashable, ...]
    images: frozenset[int]
    traits: tuple[Traits | None, ...]
    notes: tuple[tuple[str, str], ...]


@dataclass(frozen=True, eq=False)
class Text:
    """A text, and the values that it reads."""

    text: str
    data: tuple[Datum, ...]
    n_values: int


@dataclass(frozen=True, eq=False)
class One:
    """A tree by itself; mover: its displacement of vertices, if there is any."""

    surface: Text
    mover: Text | None
    traits: Traits
    notes: tuple[str, ...]


class _Values:
    """Collects the texts and the values of all materials."""

    def __init__(self, find_image: Callable[[Any], int]) -> None:
        self.words = [np.zeros(0, "u4")]
        self.attributes: dict[Hashable, int] = {}
        self.images: set[int] = set()
        self._find_image = find_image
        self._end = 0

    def place(self, text: Text) -> int:
        """Where the values of `text` begin, which are added."""
        first = self._end
        self.words += [datum.words(self._index) for datum in text.data]
        self._end += text.n_values
        return first

    def _index(self, what: str, name: Any) -> int:
        if what != "image":
            return self.attributes.setdefault(name, len(self.attributes))
        self.images.add(number := self._find_image(name))
        return number


def compile_materials(materials: Sequence[Material], find_image: Callable[[Any], int]) -> Compiled:
    """Compile the trees of those materials that the plain table does not say all of.

    find_image  the index of an image that a tree names, which need not be there
    """
    texts: dict[str, int] = {}
    movers: dict[str, int] = {}
    traits: list[Traits | None] = []
    notes, values = [], _Values(find_image)
    structure_of, mover_of = (np.full(len(materials), -1, "i4") for _ in range(2))
    keeps_normals = np.zeros(len(materials), bool)
    first_value, first_moving = (np.zeros(len(materials), "u4") for _ in range(2))
    for i, material in enumerate(materials):
        if material.is_exact or material.graph is None:
            traits.append(None)
            continue
        one = compiled_tree(material.graph)
        traits.append(one.traits)
        structure_of[i] = texts.setdefault(one.surface.text, len(texts))
        first_value[i] = values.place(one.surface)
        if one.mover:
            mover_of[i] = movers.setdefault(one.mover.text, len(movers))
            first_moving[i] = values.place(one.mover)
            keeps_normals[i] = method_of(material.graph) == "BOTH"
        notes += [(material.name, note) for note in one.notes]
    return Compiled(tuple(texts), structure_of, first_value, np.concatenate(values.words), tuple(movers), mover_of,
                    first_moving, keeps_normals, tuple(values.attributes), frozenset(values.images), tuple(traits),
                    tuple(notes))


_remembered: dict[int, tuple[Graph, One]] = {}


def compiled_tree(graph: Graph) -> One:
    """The tree of a surface; remembered for as long as the Graph is the same object."""
    known = _remembered.get(id(graph))
    if known is None or known[0] is not graph:
        while len(_remembered) >= MOST_REMEMBERED:
            _remembered.pop(next(iter(_remembered)))
        known = _remembered[id(graph)] = graph, _compile(graph)
    return known[1]


def _compile(graph: Graph) -> One:
    notes: dict[str, None] = {}
    built = Built(graph, {"surface": graph.surface, "displacement": graph.displacement}, notes.setdefault)
    found = leaves(built.shader("surface"))
    writer, normal, is_at_rest = Writer(), normal_of(graph, built), method_of(graph) == "BOTH"
    if (lit := built.lit()) is not None:
        # First the point is what is lit, then the tree goes on with that light
        writer.use("nodes/style.glsl")
        found_lit = leaves(lit)
        writer.closures(found_lit, normal, "lit", is_at_rest)
        writer.closures(found, normal, STYLED, is_at_rest)
        writer.add(_SURFACE_OF_STYLED)
        found = [*found_lit, *found]
    else:
        writer.closures(found, normal, is_at_rest=is_at_rest)
    return One(_text(writer), _mover(graph, built), traits_of(found), tuple(notes))


def _mover(graph: Graph, built: Built) -> Text | None:
    by = move_of(graph, built)
    if by is None:
        return None
    writer = Writer()
    writer.value("vec3 displacement(Geo g)", by)
    return _text(writer)


def _text(writer: Writer) -> Text:
    return Text(writer.text(), tuple(writer.data), writer.n_values)
