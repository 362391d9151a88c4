# SPDX-License-Identifier: GPL-3.0-or-later
"""What feeds a material's Displacement: a bump of all of its normals, vertices that move, or both, as it is set."""

from __future__ import annotations

from ..scene.graph import Graph
from .build import Built
from .expr import Constant, Expr, Heights, call, constant, converted, literal

_WIDTH = 0.1  # pixels between the places where heights are compared


def method_of(graph: Graph) -> str:
    """BUMP, DISPLACEMENT or BOTH."""
    return str(graph.settings.get("displacement_method", "BUMP"))


def displacement_of(built: Built) -> Expr | None:
    """Metres by which the surface moves, a vector in world space; None if nothing feeds it."""
    fed = built.value("displacement")
    return None if fed is None else converted(fed, "vec3")


def move_of(graph: Graph, built: Built) -> Expr | None:
    """By what vertices move; None where they do not."""
    by = displacement_of(built)
    is_zero = by is None or (isinstance(by, Constant) and not any(by.value))
    return None if is_zero or method_of(graph) == "BUMP" else by


def notes_of(graph: Graph) -> list[str]:
    """What is not as a setting says."""
    most = graph.settings.get("max_vertex_displacement", 0)
    if graph.displacement is None or method_of(graph) == "BUMP" or not isinstance(most, (int, float)) or most <= 0:
        return []
    return ["vertices are moved farther than Max Vertex Displacement, as Cycles does"]


def normal_of(graph: Graph, built: Built) -> Expr | None:
    """The normal that takes the place of the surface's own; None where that stays."""
    method, by = method_of(graph), displacement_of(built)
    if by is None or isinstance(by, Constant) or method == "DISPLACEMENT":
        return None
    normal = call("normal_of_point")
    height = call("height_along", by, normal)
    places = Heights("vec3", height, _WIDTH)
    function = "bumped_normal_of_object" if method == "BOTH" else "bumped_normal"
    return call(function, places["x"], places["y"], places["z"], normal, constant(1.0), constant(1.0), literal(_WIDTH))
