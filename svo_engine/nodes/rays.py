# SPDX-License-Identifier: GPL-3.0-or-later
"""Trees of the world and of lamps, as one kind of ray sees them: Light Path and Light Falloff are constants there."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ..scene.graph import Graph, Link, Node

FAR = 1e30  # metres: the length of a ray that leaves the scene

# By output of a Light Path: what a camera's ray finds, and the light that a surface gets, which Cycles counts as one
# bounce more
CAMERA: Mapping[str, float] = {"Is Camera Ray": 1.0, "Ray Length": FAR, "Ray Depth": 1.0}
LIGHT: Mapping[str, float] = {"Is Diffuse Ray": 1.0, "Is Reflection Ray": 1.0, "Ray Length": FAR, "Ray Depth": 2.0,
                              "Diffuse Depth": 1.0}
LAMP: Mapping[str, float] = {"Ray Depth": 1.0}
CONSTANTS = "Constants"  # a kind of node: its outputs are its settings

_POWERS = {"Quadratic": "QUADRATIC", "Linear": "LINEAR", "Constant": "CONSTANT"}


@dataclass(frozen=True)
class Falloff:
    """How a lamp's light falls with distance, as `scene.types.Light` has it."""

    falloff: str = "QUADRATIC"
    smoothing: float = 0.0


def seen_by(graph: Graph, rays: Mapping[str, float]) -> Graph:
    """The graph with the outputs of its Light Path nodes at `rays`, 0 where that says nothing."""

    def changed(node: Node) -> Node:
        if node.kind == "ShaderNodeLightPath":
            return replace(node, kind=CONSTANTS, settings=rays, inputs={})
        return node

    return _rewritten(graph, changed)


def asks_for_rays(graph: Graph) -> bool:
    """Whether it has a Light Path node."""
    return any(node.kind == "ShaderNodeLightPath" for node in nodes_of(graph))


def of_lamp(graph: Graph) -> Graph:
    """The graph of a lamp with Parametric, which lamps have, for UV coordinates, which are the same there."""

    def replaced(nodes: tuple[Node, ...]) -> tuple[Node, ...]:
        last = len(nodes)
        uv = {(i, "UV") for i, n in enumerate(nodes) if n.kind in ("ShaderNodeTexCoord", "ShaderNodeUVMap")}

        def linked(value: Any) -> Any:
            is_uv = isinstance(value, Link) and (value.node, value.output) in uv
            return Link(last, "Parametric") if is_uv else value

        made = (replace(n, inputs={name: linked(value) for name, value in n.inputs.items()}) for n in nodes)
        return (*made, Node("ShaderNodeNewGeometry", name="Parametric"))

    groups = {name: replace(group, nodes=replaced(group.nodes)) for name, group in graph.groups.items()}
    return replace(graph, nodes=replaced(graph.nodes), groups=groups)


def without_falloff(graph: Graph, warn: Callable[[str], object]) -> tuple[Graph, Falloff]:
    """The graph with each Light Falloff node's strength at its outputs, and the falloff of the first that is used."""
    found = dict.fromkeys(_falloffs(graph))
    if len(found) > 1:
        warn("several Light Falloffs are not supported; the first one counts for all light of the lamp")

    def changed(node: Node) -> Node:
        if node.kind != "ShaderNodeLightFalloff":
            return node
        outputs = dict.fromkeys(_POWERS, "Strength")
        return replace(node, through=outputs)

    return _rewritten(graph, changed), next(iter(found), Falloff())


def nodes_of(graph: Graph) -> Iterator[Node]:
    """All nodes, those in groups too."""
    yield from graph.nodes
    for group in graph.groups.values():
        yield from group.nodes


def _falloffs(graph: Graph) -> Iterator[Falloff]:
    """Of each output of a Light Falloff that feeds anything. A smoothing that is linked counts as none."""
    for nodes in (graph.nodes, *(group.nodes for group in graph.groups.values())):
        for link in (link for node in nodes for link in node.inputs.values() if isinstance(link, Link)):
            node = nodes[link.node]
            if node.kind == "ShaderNodeLightFalloff" and node.through is None and link.output in _POWERS:
                smooth: Any = node.inputs.get("Smooth", 0.0)
                yield Falloff(_POWERS[link.output], float(smooth) if isinstance(smooth, (int, float)) else 0.0)


def _rewritten(graph: Graph, changed: Callable[[Node], Node]) -> Graph:
    groups = {name: replace(group, nodes=tuple(map(changed, group.nodes))) for name, group in graph.groups.items()}
    return replace(graph, nodes=tuple(map(changed, graph.nodes)), groups=groups)
