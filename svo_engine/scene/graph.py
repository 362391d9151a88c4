# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees as data: every node as Blender has it, none of them understood. Whoever compiles a tree says what it does
not know.

Nodes name each other by their place in a tuple and groups by name, so that nothing is nested: a tree may hold cycles,
and groups that hold themselves or are missing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from ..errors import SceneError

# None, bool, int, float, str, or a tuple of such
Plain = Any


@dataclass(frozen=True)
class Link:
    """What feeds an input: the output `output` (its identifier) of the node at `node` in the same tuple."""

    node: int
    output: str


@dataclass(frozen=True)
class Node:
    """One node.

    kind      Blender's `bl_idname`, reroutes, group nodes and the ends of groups included
    settings  its properties by name: numbers, strings and tuples. A datablock is its full name, None without one:
              "image" names an image; "node_tree" a group of the Graph; "object" an
              object, with its matrix (16 numbers, by rows) as "object.matrix_world". Of a record it is
              "record.property". "color_ramp" is (color_mode, interpolation, hue_interpolation, ((position, r, g, b, a),
              ...)). "mapping" (curves) is (extend, (min_x, min_y, max_x, max_y) or None without clipping, (black),
              (white), for each curve its points ((x, y, handle), ...)); "mapping.samples" has for each curve the values
              that Blender gives at even steps from the first to the last x of all curves; a fourth curve, if there is
              one, comes before each of the others and is not listed. None if no curve changes anything. "ies.text" and
              "script.text" are what the file or the text block holds, None if that cannot be read
    inputs    by identifier, those that the node's settings leave in use: a Link, or the constant; None for a shader
              and for what has no constant in the editor, such as normals and texture coordinates
    name      for messages
    through   the node is muted if not None: which input each output passes on
    """

    kind: str
    settings: Mapping[str, Plain] = field(default_factory=dict, hash=False)
    inputs: Mapping[str, Link | Plain] = field(default_factory=dict, hash=False)
    name: str = ""
    through: Mapping[str, str] | None = field(default=None, hash=False)


@dataclass(frozen=True)
class Group:
    """A node group. outputs: as a Node's inputs. aovs: the nodes among `nodes` that are AOV outputs."""

    nodes: tuple[Node, ...] = ()
    outputs: Mapping[str, Link | Plain] = field(default_factory=dict, hash=False)
    aovs: tuple[int, ...] = ()


@dataclass(frozen=True)
class Graph:
    """The nodes that an output of a material, a world or a lamp reaches, each once, in the order of their tree.

    surface, volume, displacement  what feeds the active output; None if nothing does
    aovs      the nodes among `nodes` that are AOV outputs
    groups    all groups that are named, by name; one that is missing has no entry
    settings  of the datablock, as far as they say how its tree is meant, such as "displacement_method"
    """

    nodes: tuple[Node, ...] = ()
    surface: Link | None = None
    volume: Link | None = None
    displacement: Link | None = None
    aovs: tuple[int, ...] = ()
    groups: Mapping[str, Group] = field(default_factory=dict, hash=False)
    settings: Mapping[str, Plain] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        ends = {"surface": self.surface, "volume": self.volume, "displacement": self.displacement}
        _check_tree("Graph", self.nodes, ends, self.aovs)
        for name, group in self.groups.items():
            _check_tree(f"Node group '{name}'", group.nodes, group.outputs, group.aovs)


def _check_tree(owner: str, nodes: tuple[Node, ...], ends: Mapping[str, Any], aovs: Iterable[int]) -> None:
    """Raise SceneError if a node is named that is not there."""
    for number in (*(link.node for link in _links(nodes, ends)), *aovs):
        if not 0 <= number < len(nodes):
            raise SceneError(f"{owner}: node {number} of {len(nodes)} is named")


def _links(nodes: tuple[Node, ...], ends: Mapping[str, Any]) -> Iterator[Link]:
    for inputs in (ends, *(node.inputs for node in nodes)):
        for value in inputs.values():
            if isinstance(value, Link):
                yield value


def packed(graph: Graph) -> dict[str, Any]:
    """`graph` as JSON can hold it."""
    groups = {name: {"nodes": _packed_nodes(g.nodes), "outputs": _packed_inputs(g.outputs), "aovs": list(g.aovs)}
              for name, g in graph.groups.items()}
    ends = {"surface": graph.surface, "volume": graph.volume, "displacement": graph.displacement}
    return {"nodes": _packed_nodes(graph.nodes), "ends": _packed_inputs(ends), "aovs": list(graph.aovs),
            "groups": groups, "settings": dict(graph.settings)}


def _packed_nodes(nodes: tuple[Node, ...]) -> list[list[Any]]:
    return [[n.kind, n.name, dict(n.settings), _packed_inputs(n.inputs), None if n.through is None else dict(n.through)]
            for n in nodes]


def _packed_inputs(inputs: Mapping[str, Any]) -> dict[str, Any]:
    return {name: {"link": [v.node, v.output]} if isinstance(v, Link) else v for name, v in inputs.items()}


def unpacked(tree: Any) -> Graph:
    """The Graph of what `packed` gave. SceneError for all else."""
    try:
        groups = {str(name): Group(_nodes(g["nodes"]), _inputs(g["outputs"]), tuple(map(_number, g["aovs"])))
                  for name, g in tree["groups"].items()}
        ends = {name: _end(value) for name, value in _inputs(tree["ends"]).items()}
        return Graph(_nodes(tree["nodes"]), aovs=tuple(map(_number, tree["aovs"])), groups=groups,
                     settings=_settings(tree["settings"]), **ends)
    except (TypeError, ValueError, KeyError, AttributeError, RecursionError) as error:
        raise SceneError("a node tree is damaged") from error


def _nodes(rows: Any) -> tuple[Node, ...]:
    return tuple(Node(_text(kind), _settings(settings), _inputs(inputs), _text(name), _through(through))
                 for kind, name, settings, inputs, through in rows)


def _inputs(tree: Any) -> dict[str, Any]:
    return {name: _link(value["link"]) if isinstance(value, dict) else _plain(value) for name, value in tree.items()}


def _settings(tree: Any) -> dict[str, Plain]:
    return {name: _plain(value) for name, value in tree.items()}


def _through(tree: Any) -> dict[str, str] | None:
    return None if tree is None else {output: _text(name) for output, name in tree.items()}


def _link(pair: Any) -> Link:
    node, output = pair
    return Link(_number(node), _text(output))


def _end(value: Any) -> Link | None:
    if value is not None and not isinstance(value, Link):
        raise TypeError(value)
    return value


def _plain(value: Any) -> Plain:
    """Lists as tuples."""
    if isinstance(value, list):
        return tuple(map(_plain, value))
    if isinstance(value, dict):
        raise TypeError(value)
    return value


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(value)
    return value


def _number(value: Any) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise TypeError(value)
    return value
