# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes by the names that shader nodes know them by.

A name is a string: that of an attribute, as the Attribute node has it; or a pair:

    ("uv", name), ("color", name)   the UV map or colour attribute; of an empty name the active one
    ("tangent", name)               tangents along u of a UV map, and in a fourth number the side of v
    ("island", ""), ("pointiness", "")
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from weakref import WeakKeyDictionary

from .geometry import REST, Attribute, Instances, Mesh, with_fields
from .islands import islands, pointiness
from .tangents import tangents

_made: WeakKeyDictionary[Mesh, dict[Hashable, Attribute | None]] = WeakKeyDictionary()

# Names by which Cycles knows what it makes itself
_STANDARD: dict[str, tuple[str, str]] = {"uv": ("uv", ""), "pointiness": ("pointiness", ""),
                                         "random_per_island": ("island", "")}


def named_attribute(mesh: Mesh, instances: Instances, name: Hashable) -> Attribute | None:
    """The attribute of that name for the shown mesh; None if neither it nor its instances have one. Always the same
    object for the same mesh."""
    known = _made.setdefault(mesh, {})
    if name not in known:
        known[name] = _of_mesh(mesh, name)
    found = known[name]
    if found is None and isinstance(name, str):
        found = next((a for a in instances.attributes if a.name == name), None)
    return found


def _of_mesh(mesh: Mesh, name: Hashable) -> Attribute | None:
    if isinstance(name, str):
        found = mesh.attribute(name)
        return _of_mesh(mesh, _STANDARD[name]) if found is None and name in _STANDARD else found
    if not isinstance(name, tuple):
        return None
    what, which = name
    make = _MAKERS.get(what)
    return None if make is None else make(mesh, which)


def _uv(mesh: Mesh, name: str) -> Attribute | None:
    found = mesh.attribute(name or mesh.uv_map)
    return found if found is not None and (found.domain, found.values.shape[1]) == ("CORNER", 2) else None


def _color(mesh: Mesh, name: str) -> Attribute | None:
    return mesh.attribute(name or mesh.color)


def _tangent(mesh: Mesh, name: str) -> Attribute | None:
    uv_map = _uv(mesh, name)
    if uv_map is None:
        return None
    return Attribute("tangent", "CORNER", tangents(mesh, uv_map.values.reshape(-1, 3, 2)))


def _island(mesh: Mesh, _name: str) -> Attribute | None:
    return Attribute("island", "FACE", islands(mesh)[:, None])


def _pointiness(mesh: Mesh, _name: str) -> Attribute | None:
    rest = mesh.attribute(REST)
    mesh = mesh if rest is None else with_fields(mesh, positions=rest.values)
    return Attribute("pointiness", "POINT", pointiness(mesh)[:, None].astype("f4"))


_MAKERS: dict[str, Callable[[Mesh, str], Attribute | None]] = {
    "uv": _uv, "color": _color, "tangent": _tangent, "island": _island, "pointiness": _pointiness}
