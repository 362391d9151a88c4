# SPDX-License-Identifier: GPL-3.0-or-later
"""A tree's nodes turned into expressions and closures, by the kinds' functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from ..scene.graph import Graph, Link, Node
from .closures import Closure, Leaf
from .expr import Expr, constant, converted
from .kinds import LIT, Outputs, kinds
from .reader import Reader
from .tree import Place, Source, Tree


class Built:
    """The nodes of a Graph that its ends need, each made once.

    warn  called with a sentence for each thing that is not as in Blender
    """

    def __init__(self, graph: Graph, ends: Mapping[str, Link | None], warn: Callable[[str], object]) -> None:
        self._warn = warn
        self._tree = Tree(graph, warn)
        self._ends = {name: self._tree.resolve((), link) for name, link in ends.items()}
        self._outputs: dict[Place, Outputs] = {}
        order = self._tree.order(list(self._ends.values()))
        self._used = self._tree.used(order, list(self._ends.values()))
        for place in order:
            self._outputs[place] = self._make(place)

    def shader(self, end: str) -> Closure | None:
        """The closure at an end; what is no shader is sent out as light, as Cycles does."""
        fed = self._fed(self._ends[end])
        if isinstance(fed, Expr):
            return Leaf("closure_emission", (converted(fed, "vec3"), constant(1.0)))
        return fed if isinstance(fed, Closure) else None

    def lit(self) -> Closure | None:
        """The shader whose light the tree asks for as a colour; of several the first."""
        found = [outputs[LIT] for outputs in self._outputs.values() if LIT in outputs]
        if len(found) > 1:
            self._warn("light is asked for as a colour more than once; that of the first Shader to RGB stands for all")
        return found[0] if found and isinstance(found[0], Closure) else None

    def value(self, end: str) -> Expr | None:
        """The expression at an end; None without one."""
        fed = self._fed(self._ends[end])
        return fed if isinstance(fed, Expr) else None

    def _make(self, place: Place) -> Outputs:
        node = self._tree.node(place)
        function = kinds().get(node.kind)
        if function is None:
            return self._guess(place, node)
        return function(Reader(node, partial(self._feed, place), partial(self._is_linked, place),
                               lambda output: (place, output) in self._used, self._warn))

    def _guess(self, place: Place, node: Node) -> Outputs:
        """Of a kind that nobody knows: what feeds its first linked input, for every output."""
        self._warn(f"node '{node.name}' ({node.kind}) is not supported; its first linked input stands in")
        fed = (self._feed(place, identifier) for identifier in node.inputs)
        return _Everywhere(next((f for f in fed if isinstance(f, (Expr, Closure))), None))

    def _feed(self, place: Place, identifier: str) -> Any:
        return self._fed(self._tree.source(place, identifier))

    def _is_linked(self, place: Place, identifier: str) -> bool:
        return self._tree.source(place, identifier).place is not None

    def _fed(self, source: Source) -> Any:
        """What a source gives; None where it is part of a ring, or the node has no such output."""
        if source.place is None:
            return source.value
        return self._outputs[source.place].get(source.output) if source.place in self._outputs else None


class _Everywhere(dict[str, Any]):
    """The same for every key."""

    def __init__(self, value: Any) -> None:
        super().__init__()
        self._value = value

    def get(self, key: str, default: Any = None) -> Any:  # noqa: ARG002 - all have one value
        return self._value
