# SPDX-License-Identifier: GPL-3.0-or-later
"""Mixtures of shaders. However they share their parts, each closure is written once, with the sum of its weights."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count

from .expr import Expr, call, literal

_numbers = count()


class Closure:
    """What a shader socket gives. Made after its parts, so that numbers ascend from them to it."""

    def __init__(self) -> None:
        self.number = next(_numbers)

    def parts(self) -> tuple[tuple[Closure, Expr | None], ...]:
        """Its parts with their shares; None for all."""
        return ()


class Leaf(Closure):
    """One closure: a function of shaders/nodes and what it is given."""

    def __init__(self, name: str, arguments: tuple[Expr, ...]) -> None:
        super().__init__()
        self.name, self.arguments = name, arguments


class Mixture(Closure):
    """first and second with the shares 1 - factor and factor; with both whole if that is None. None adds nothing."""

    def __init__(self, factor: Expr | None, first: Closure | None, second: Closure | None) -> None:
        super().__init__()
        self._factor, self._first, self._second = factor, first, second

    def parts(self) -> tuple[tuple[Closure, Expr | None], ...]:
        """As `Closure.parts`."""
        shares: tuple[Expr | None, Expr | None] = (None, None)
        if self._factor is not None:
            shares = call("share_of_first", self._factor), call("share_of_second", self._factor)
        both = zip((self._first, self._second), shares, strict=True)
        return tuple((part, share) for part, share in both if part is not None)


@dataclass(frozen=True, eq=False)
class Weighted:
    """A leaf and its weight."""

    weight: Expr
    leaf: Leaf


def leaves(root: Closure | None) -> list[Weighted]:
    """All closures of a mixture with their weights, in the order in which they were made."""
    if root is None:
        return []
    reached = {root.number: root}
    waiting = [root]
    while waiting:
        for part, _ in waiting.pop().parts():
            if part.number not in reached:
                reached[part.number] = part
                waiting.append(part)
    whole = literal(1.0)
    weights: dict[int, Expr] = {root.number: whole}
    found = []
    for number in sorted(reached, reverse=True):
        closure, weight = reached[number], weights[number]
        if isinstance(closure, Leaf):
            found.append(Weighted(weight, closure))
        for part, share in closure.parts():
            own = weight if share is None else share if weight is whole else call("product_of_weights", weight, share)
            before = weights.get(part.number)
            weights[part.number] = own if before is None else call("sum_of_weights", before, own)
    return found[::-1]
