# SPDX-License-Identifier: GPL-3.0-or-later
"""What the closures of a tree can do, so that a frame can leave out what none of them does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .closures import Leaf, Weighted
from .emit import in_order
from .expr import Call, Constant, Expr, Literal
from .signatures import library

_DIFFUSE = {"closure_diffuse", "closure_emission", "closure_transparent", "closure_translucent", "closure_holdout",
            "closure_sheen", "closure_velvet", "closure_toon", "closure_subsurface"}
_GLASS = {"closure_glass", "closure_refraction"}


@dataclass(frozen=True)
class Traits:
    """emits: sends out light; mirrors: reflects, transmits or colours what passes, other than diffusely; transmits:
    through the surface; passes: lets rays pass as they came; varies: is not the same everywhere.
    """

    emits: bool
    mirrors: bool
    transmits: bool
    passes: bool
    varies: bool


def traits_of(found: Sequence[Weighted]) -> Traits:
    """Of the closures of a tree, as far as constants tell: what varies can be anything."""
    used = [w.leaf for w in found if not _is_zero(w.weight)]
    passes = any(leaf.name == "closure_transparent" or _less_than_one(leaf, "alpha") for leaf in used)
    return Traits(
        emits=any(_given(leaf, "strength", "emission_strength") for leaf in used),
        mirrors=any(_is_colored(leaf) for leaf in used) or any(leaf.name not in _DIFFUSE for leaf in used),
        transmits=any(leaf.name in _GLASS or _given(leaf, "transmission") for leaf in used),
        passes=passes,
        varies=any(_varies(expr) for w in found for expr in (w.weight, *w.leaf.arguments)))


def _varies(root: Expr) -> bool:
    """Whether it looks at the point where it is evaluated, other than for its normal."""
    return any(isinstance(expr, Call) and expr.signature.takes_geo and expr.signature.name != "normal_of_point"
               for expr in in_order([root]))


def _is_colored(leaf: Leaf) -> bool:
    """Whether light that passes may change its colour: it is followed as through a pane, where grey takes chances."""
    return leaf.name == "closure_transparent" and any(
        not isinstance(color, Constant) or len(set(color.value)) > 1 for color in _arguments(leaf, "color"))


def _given(leaf: Leaf, *names: str) -> bool:
    """Whether an argument of one of these names is there and can be other than zero."""
    return any(not _is_zero(expr) for expr in _arguments(leaf, *names))


def _less_than_one(leaf: Leaf, name: str) -> bool:
    return any(not isinstance(expr, Constant) or expr.value[0] < 1 for expr in _arguments(leaf, name))


def _arguments(leaf: Leaf, *names: str) -> list[Expr]:
    named = zip(library()[leaf.name].names, leaf.arguments, strict=True)
    return [expr for name, expr in named if name in names]


def _is_zero(expr: Expr) -> bool:
    return isinstance(expr, (Constant, Literal)) and not any(expr.value)
