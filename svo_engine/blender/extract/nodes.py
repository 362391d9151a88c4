# SPDX-License-Identifier: GPL-3.0-or-later
"""Walking shader node trees: what feeds a socket, through reroutes, muted nodes and groups."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

from ...scene.types import Color


@dataclass(frozen=True)
class Port:
    """A socket, with the group nodes that one went through to reach it, the outermost first."""

    socket: Any
    groups: tuple[Any, ...] = ()

    @property
    def node(self) -> Any:
        """The node that has the socket."""
        return self.socket.node

    @property
    def is_constant(self) -> bool:
        """Nothing feeds it: its value is the one beside it in the node editor."""
        return not self.socket.is_output

    def input(self, identifier: str) -> Port | None:
        """The input `identifier` of this port's node; None if this version's node has no such input."""
        socket = _find(self.node.inputs, identifier)
        return None if socket is None else Port(socket, self.groups)


def tree_of(owner: Any) -> Any:
    """The node tree that a material, world or lamp is drawn with; None if it does not use nodes."""
    with warnings.catch_warnings():  # Blender 5 still has the switch, but warns of it: nodes are always used there
        warnings.simplefilter("ignore", DeprecationWarning)
        return owner.node_tree if getattr(owner, "use_nodes", True) else None


def fed_output(tree: Any, identifier: str) -> Port | None:
    """What feeds the input `identifier` of the tree's output, Cycles' own if there is one; None without any."""
    node = tree.get_output_node("CYCLES") or tree.get_output_node("EEVEE")
    socket = None if node is None else _find(node.inputs, identifier)
    return None if socket is None else origin(Port(socket))


def origin(port: Port) -> Port:
    """The output of a real node that feeds the input `port`, or the input whose constant holds if nothing does."""
    while True:
        link = next((k for k in port.socket.links if k.is_valid and not k.is_muted), None)
        if link is None:
            return port
        before = _before(Port(link.from_socket, port.groups))
        if before is None:
            return port
        if before.socket.is_output:
            return before
        port = before


def _before(port: Port) -> Port | None:
    """The input that stands behind an output of a reroute, muted node or group; `port` itself for all other nodes.

    None: there is nothing behind it.
    """
    node = port.node
    if node.mute:
        inside = next((k.from_socket for k in node.internal_links if k.to_socket == port.socket), None)
        return None if inside is None else Port(inside, port.groups)
    if node.bl_idname == "NodeReroute":
        return Port(node.inputs[0], port.groups)
    if node.bl_idname == "NodeGroupInput" and port.groups:
        outside = _find(port.groups[-1].inputs, port.socket.identifier)
        return None if outside is None else Port(outside, port.groups[:-1])
    if node.bl_idname == "ShaderNodeGroup":
        ends = [n for n in node.node_tree.nodes if n.bl_idname == "NodeGroupOutput"] if node.node_tree else []
        end = next((n for n in ends if n.is_active_output), None)
        inside = None if end is None else _find(end.inputs, port.socket.identifier)
        return None if inside is None else Port(inside, (*port.groups, node))
    return port


def _find(sockets: Any, identifier: str) -> Any:
    return next((s for s in sockets if s.identifier == identifier), None)


def constant_color(socket: Any) -> Color:
    """A socket's constant as a colour: numbers as grey; black for sockets without a value."""
    value: Any = getattr(socket, "default_value", 0.0)
    if hasattr(value, "__len__"):
        return float(value[0]), float(value[1]), float(value[2])
    return float(value), float(value), float(value)
