# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees, copied for scene/graph.py. Nothing here knows what a node does or fails for a strange one."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ...scene.graph import Graph, Group, Link, Node, Plain
from .node_settings import plain, settings_of_node, settings_of_owner

_OF_ALL_TREES = {"NodeReroute", "NodeFrame", "NodeGroupInput", "NodeGroupOutput"}

# The socket at the end of a group that makes a new one of what is linked to it
_VIRTUAL = "__extend__"

def read_graph(tree: Any, owner: Any) -> Graph | None:
    """What the active output of `tree`, the node tree of the datablock `owner`, reaches; None without a tree."""
    if tree is None:
        return None
    if hasattr(owner, "inline_shader_nodes") and _has_zones(tree, set()):  # Blender 5 brought both
        inlined = owner.inline_shader_nodes()  # its tree lives as long as it does
        tree = inlined.node_tree
    end = tree.get_output_node("CYCLES") or tree.get_output_node("EEVEE")
    groups: dict[str, Any] = {}
    nodes, found, aovs = _read(tree, end, groups)
    ends = {name: link for name, link in found.items() if isinstance(link, Link)}
    return Graph(nodes, ends.get("Surface"), ends.get("Volume"), ends.get("Displacement"), aovs,
                 _read_groups(groups), settings_of_owner(owner))


def _has_zones(tree: Any, seen: set[str]) -> bool:
    """Whether `tree` or a group in it has nodes that Blender takes away for renderers: loops, closures, bundles."""
    seen.add(tree.name_full)
    for node in tree.nodes:
        kind = node.bl_idname
        if kind == "ShaderNodeGroup":
            inner = node.node_tree
            if inner is not None and inner.name_full not in seen and _has_zones(inner, seen):
                return True
        elif not kind.startswith("ShaderNode") and kind not in _OF_ALL_TREES:
            return True
    return False


def _read_groups(trees: dict[str, Any]) -> dict[str, Group]:
    """All groups that `trees` name and that are named inside of them, each once."""
    made: dict[str, Group] = {}
    while new := [name for name in trees if name not in made]:
        for name in new:
            nodes = [n for n in trees[name].nodes if n.bl_idname == "NodeGroupOutput"]
            end = next((n for n in nodes if n.is_active_output), None)
            made[name] = Group(*_read(trees[name], end, trees))
    return {name: made[name] for name in sorted(made)}


def _read(tree: Any, end: Any, groups: dict[str, Any]) -> tuple[tuple[Node, ...], dict[str, Plain], tuple[int, ...]]:
    """The nodes of `tree` that its output `end` (or None) and its AOV outputs reach, what feeds the output, and the AOV
    outputs among them. Groups that are named are added to `groups`."""
    feeds = _feeds(tree)
    aovs = [n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputAOV"]
    reached = _reached(feeds, [*aovs, *([] if end is None else [end])])
    place: dict[int, int] = {}
    for node in tree.nodes:
        pointer = node.as_pointer()
        if pointer in reached and (end is None or pointer != end.as_pointer()):
            place[pointer] = len(place)
    used = [node for node in tree.nodes if node.as_pointer() in place]
    made = tuple(Node(n.bl_idname, settings_of_node(n, groups), _inputs(n, feeds, place), n.name, _through(n))
                 for n in used)
    found = {} if end is None else _inputs(end, feeds, place)
    return made, found, tuple(place[n.as_pointer()] for n in aovs)


# Of a node's address: for each address of its fed inputs, the node before it and that one's output
_Feeds = dict[int, dict[int, tuple[Any, str]]]


def _feeds(tree: Any) -> _Feeds:
    """All links that count. One walk over them: to ask each socket for its own is quadratic."""
    feeds: _Feeds = {}
    passing: dict[int, Any] = {}
    for link in tree.links:
        before = link.from_node
        if link.is_valid and not link.is_muted and before is not None and link.to_node is not None:
            sockets = feeds.setdefault(link.to_node.as_pointer(), {})
            sockets.setdefault(link.to_socket.as_pointer(), (before, link.from_socket.identifier))
            if before.mute or before.bl_idname == "NodeReroute":
                passing[before.as_pointer()] = before
    return _without_dead_ends(feeds, passing) if passing else feeds


def _without_dead_ends(feeds: _Feeds, passing: dict[int, Any]) -> _Feeds:
    """`feeds` without those that lead back, through nodes that only pass on, to an input that nothing feeds: it does
    not count what such an input has, but what the one has that asks."""
    ways = {pointer: _ways(node) for pointer, node in passing.items()}

    def is_fed(node: Any, output: str) -> bool:
        seen = set()
        while (pointer := node.as_pointer()) in ways and (pointer, output) not in seen:
            seen.add((pointer, output))
            before = feeds.get(pointer, {}).get(ways[pointer].get(output, 0))
            if before is None:
                return False
            node, output = before
        return pointer not in ways

    return {to: {socket: before for socket, before in sockets.items() if is_fed(*before)}
            for to, sockets in feeds.items()}


def _ways(node: Any) -> dict[str, int]:
    """Of a node that only passes on: output -> address of the input behind it."""
    if node.bl_idname == "NodeReroute":
        return {node.outputs[0].identifier: node.inputs[0].as_pointer()}
    return {link.to_socket.identifier: link.from_socket.as_pointer() for link in node.internal_links}


def _reached(feeds: _Feeds, ends: Iterable[Any]) -> set[int]:
    """Addresses of the nodes `ends` and of all before them."""
    waiting = [node.as_pointer() for node in ends]
    reached = set(waiting)
    while waiting:
        for before, _ in feeds.get(waiting.pop(), {}).values():
            pointer = before.as_pointer()
            if pointer not in reached:
                reached.add(pointer)
                waiting.append(pointer)
    return reached


def _inputs(node: Any, feeds: _Feeds, place: dict[int, int]) -> dict[str, Plain]:
    """What feeds each input. A hidden vector stands for a normal or for coordinates; hidden colours count, and hidden
    numbers of groups."""
    fed, is_group = feeds.get(node.as_pointer(), {}), node.bl_idname == "ShaderNodeGroup"
    made: dict[str, Plain] = {}
    for socket in node.inputs:
        if socket.is_unavailable or (identifier := socket.identifier) == _VIRTUAL:
            continue
        before = fed.get(socket.as_pointer()) if fed else None
        if before is not None and (number := place.get(before[0].as_pointer())) is not None:
            made[identifier] = Link(number, before[1])
        else:
            kind = socket.type
            has_constant = not socket.hide_value or kind == "RGBA" or (is_group and kind != "VECTOR")
            made[identifier] = plain(getattr(socket, "default_value", None)) if has_constant else None
    return made


def _through(node: Any) -> dict[str, str] | None:
    """Of a muted node, which input each output passes on."""
    if not node.mute:
        return None
    return {link.to_socket.identifier: link.from_socket.identifier for link in node.internal_links}
