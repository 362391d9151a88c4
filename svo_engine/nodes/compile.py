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
from .displacement import method_of, normal_of, notes_of
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
    attributes    names of the attributes that trees ask for, by number
    images        indices of the images that trees read
    traits        of each material what its tree can do; None for one without a tree of its own
    notes         (material, sentence): what is not as in Blender
    """

    structures: tuple[str, ...]
    structure_of: np.ndarray
    first_value: np.ndarray
    values: np.ndarray
    attributes: tuple[Hashable, ...]
    images: frozenset[int]
    traits: tuple[Traits | None, ...]
    notes: tuple[tuple[str, str], ...]


@dataclass(frozen=True, eq=False)
class One:
    """A tree by itself."""

    text: str
    data: tuple[Datum, ...]
    n_values: int
    traits: Traits
    notes: tuple[str, ...]


def compile_materials(materials: Sequence[Material], find_image: Callable[[Any], int]) -> Compiled:
    """Compile the trees of those materials that the plain table does not say all of.

    find_image  the index of an image that a tree names, which need not be there
    """
    texts: dict[str, int] = {}
    attributes: dict[Hashable, int] = {}
    images: set[int] = set()
    traits: list[Traits | None] = []
    notes, words = [], [np.zeros(0, "u4")]
    structure_of = np.full(len(materials), -1, "i4")
    first_value = np.zeros(len(materials), "u4")
    n_values = 0

    def index(what: str, name: Any) -> int:
        if what != "image":
            return attributes.setdefault(name, len(attributes))
        images.add(number := find_image(name))
        return number

    for i, material in enumerate(materials):
        if material.is_exact or material.graph is None:
            traits.append(None)
            continue
        one = compiled_tree(material.graph)
        traits.append(one.traits)
        structure_of[i], first_value[i] = texts.setdefault(one.text, len(texts)), n_values
        words += [datum.words(index) for datum in one.data]
        n_values += one.n_values
        notes += [(material.name, note) for note in one.notes]
    return Compiled(tuple(texts), structure_of, first_value, np.concatenate(words), tuple(attributes),
                    frozenset(images), tuple(traits), tuple(notes))


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
    notes: dict[str, None] = dict.fromkeys(notes_of(graph))
    built = Built(graph, {"surface": graph.surface, "displacement": graph.displacement}, notes.setdefault)
    found = leaves(built.shader("surface"))
    writer, normal = Writer(), normal_of(graph, built)
    is_bumped = normal is not None
    if normal is not None:
        writer.displaced_normal(normal, at_rest=method_of(graph) == "BOTH")
    if (lit := built.lit()) is not None:
        # First the point is what is lit, then the tree goes on with that light
        writer.use("nodes/style.glsl")
        found_lit = leaves(lit)
        writer.closures(found_lit, is_bumped, "lit")
        writer.closures(found, is_bumped, STYLED)
        writer.add(_SURFACE_OF_STYLED)
        found = [*found_lit, *found]
    else:
        writer.closures(found, is_bumped)
    return One(writer.text(), tuple(writer.data), writer.n_values, traits_of(found), tuple(notes))
