# SPDX-License-Identifier: GPL-3.0-or-later
"""What feeds what in a Graph, with groups, reroutes and muted nodes looked through."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from ..scene.graph import Graph, Group, Link, Node, Plain

MOST_DEPTH = 64  # groups in groups


@dataclass(frozen=True)
class Place:
    """A node: `frames` are the group nodes that it lies in, outermost first, each by its number in the one before."""

    frames: tuple[int, ...]
    number: int


@dataclass(frozen=True)
class Source:
    """What feeds an input: output `output` of the node at `place`, or, without a place, the constant `value`."""

    place: Place | None = None
    output: str = ""
    value: Plain = None


class Tree:
    """A Graph to ask. warn: called with a sentence for what is missing."""

    def __init__(self, graph: Graph, warn: Callable[[str], object]) -> None:
        self._graph = graph
        self._warn = warn
        self._levels: dict[tuple[int, ...], tuple[Node, ...]] = {(): graph.nodes}
        self._names: dict[tuple[int, ...], tuple[str, ...]] = {(): ()}

    def node(self, place: Place) -> Node:
        """The node there."""
        return self._levels[place.frames][place.number]

    def source(self, place: Place, identifier: str) -> Source:
        """What feeds that input of the node at `place`."""
        return self.resolve(place.frames, self.node(place).inputs.get(identifier))

    def resolve(self, frames: tuple[int, ...], value: Link | Plain) -> Source:
        """What `value`, an input of a node in those frames, comes from."""
        seen: set[tuple[tuple[int, ...], int, str]] = set()
        while isinstance(value, Link):
            key = frames, value.node, value.output
            if key in seen:  # a ring of reroutes or of groups' ends
                return Source()
            seen.add(key)
            node = self._levels[frames][value.node]
            if node.through is not None:
                value = node.inputs.get(node.through.get(value.output, ""))
            elif node.kind == "NodeReroute":
                value = next(iter(node.inputs.values()), None)
            elif node.kind == "NodeGroupInput" and frames:
                frames, outside = frames[:-1], frames[-1]
                value = self._levels[frames][outside].inputs.get(value.output)
            elif node.kind == "ShaderNodeGroup":
                frames, value = self._enter(frames, value)
            else:
                return Source(Place(frames, value.node), value.output)
        return Source(value=value)

    def order(self, roots: list[Source]) -> list[Place]:
        """All nodes that the roots need, each after those that feed it; a link that closes a ring is left out."""
        done: dict[Place, bool] = {}  # False while its inputs are looked at
        waiting: list[tuple[Place, Iterator[Place]]] = []

        def visit(place: Place) -> None:
            done[place] = False
            waiting.append((place, iter(self._before(place))))

        for root in roots:
            if root.place and root.place not in done:
                visit(root.place)
            while waiting:
                place, rest = waiting[-1]
                before = next((p for p in rest if p not in done), None)
                if before:
                    visit(before)
                else:
                    del done[place]  # so that it comes last
                    done[place] = True
                    waiting.pop()
        return list(done)

    def used(self, places: list[Place], roots: list[Source]) -> set[tuple[Place, str]]:
        """The outputs that feed any of these nodes, or that are roots."""
        sources = [self.source(place, identifier) for place in places for identifier in self.node(place).inputs]
        return {(source.place, source.output) for source in (*sources, *roots) if source.place}

    def _before(self, place: Place) -> list[Place]:
        sources = (self.source(place, identifier) for identifier in self.node(place).inputs)
        return [source.place for source in sources if source.place]

    def _enter(self, frames: tuple[int, ...], link: Link) -> tuple[tuple[int, ...], Any]:
        """Into the group that a group node names: what feeds that output of it; None if it is missing."""
        node = self._levels[frames][link.node]
        name = node.settings.get("node_tree")
        group = self._graph.groups.get(name) if isinstance(name, str) else None
        names = self._names[frames]
        if group is None or name in names or len(frames) >= MOST_DEPTH:
            self._warn(f"the group of node '{node.name}' is missing" if group is None else
                       f"the group of node '{node.name}' holds itself")
            return frames, None
        inner = (*frames, link.node)
        self._add(inner, group, (*names, str(name)))
        return inner, group.outputs.get(link.output)

    def _add(self, frames: tuple[int, ...], group: Group, names: tuple[str, ...]) -> None:
        self._levels.setdefault(frames, group.nodes)
        self._names.setdefault(frames, names)
