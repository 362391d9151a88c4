# SPDX-License-Identifier: GPL-3.0-or-later
"""What nodes ask of objects, instancers, particles and the view layer, as attributes of Instances.

Attribute nodes ask for custom properties, or for any property by its path, and get four numbers as Blender's own lookup
gives them; zeros where nothing has the name. Such an attribute is called "object:NAME", "instancer:NAME" or
"view_layer:NAME". Particle Info nodes ask for PARTICLE.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ...scene.geometry import Attribute
from ...scene.graph import Graph

Row = tuple[float, float, float, float]

_NOTHING: Row = (0.0, 0.0, 0.0, 0.0)
_UNUSED = 0x7FFFFFFF
_TYPES = ("OBJECT", "INSTANCER", "VIEW_LAYER")

# The particle that an instance is. numbers: index, age and lifetime in frames, size
PARTICLE = ("numbers", "location", "velocity", "angular_velocity")


def asked_for(graph: Graph | None) -> frozenset[tuple[str, str]]:
    """(type, name) of all that the nodes in `graph` ask for."""
    trees = () if graph is None else (graph.nodes, *(group.nodes for group in graph.groups.values()))
    asked: set[tuple[str, str]] = set()
    for node in (node for nodes in trees for node in nodes):
        kind, name = (node.settings.get(key) for key in ("attribute_type", "attribute_name"))
        if node.kind == "ShaderNodeAttribute" and kind in _TYPES and name:
            asked.add((kind, name))
        elif node.kind == "ShaderNodeParticleInfo":
            asked.update(("PARTICLE", name) for name in PARTICLE)
    return frozenset(asked)


def lookup_name(kind: str, name: str) -> str:
    """The name of the attribute of Instances that holds the values."""
    return f"{kind.lower()}:{name}"


class Lookups:
    """Collects values, one instance after another."""

    def __init__(self, layer: Any, scene: Any) -> None:
        self._layer = tuple(thing for thing in (layer, scene, scene.world) if thing is not None)
        self._frame = scene.frame_current_final
        self._rows: dict[tuple[str, str], dict[int, Row]] = {}
        self._of_points: dict[tuple[int, str], np.ndarray | None] = {}

    def note(self, row: int, instance: Any, owner: Any, asked: Iterable[tuple[str, str]]) -> None:
        """Look up all that is asked of number `row`, `instance` of the depsgraph, which shows the object `owner`."""
        for kind, name in asked:
            if kind == "VIEW_LAYER":
                value = _first(self._layer, name)
            elif kind == "PARTICLE":
                value = self._of_particle(instance, name)
            elif kind == "INSTANCER" and instance.is_instance:
                value = self._of_instancer(instance, owner, name)
            else:
                value = _first((owner, owner.data), name)
            self._rows.setdefault((kind, name), {})[row] = value

    def attributes(self, n: int) -> tuple[Attribute, ...]:
        """Of n instances."""
        made = []
        for kind, name in sorted(self._rows):
            values = np.zeros((n, 4), "f4")
            rows = self._rows[kind, name]
            values[list(rows)] = list(rows.values())
            made.append(Attribute(lookup_name(kind, name), "INSTANCE", np.nan_to_num(values)))
        return tuple(made)

    def _of_instancer(self, instance: Any, owner: Any, name: str) -> Row:
        particles, parent = instance.particle_system, instance.parent
        found = _first((particles.settings,), name) if particles else _NOTHING
        if found is not _NOTHING:
            return found
        points = self._points(parent, name)
        if points is not None and 0 <= (number := _outermost(instance.persistent_id)) < len(points):
            r, g, b, a = points[number].tolist()
            return r, g, b, a
        return _first((parent, parent.data, owner, owner.data), name)

    def _of_particle(self, instance: Any, name: str) -> Row:
        system = instance.particle_system if instance.is_instance else None
        number = instance.persistent_id[0] if system else -1
        if system is None or not 0 <= number < len(system.particles):
            return _NOTHING
        particle = system.particles[number]
        if name == "numbers":
            return float(number), self._frame - particle.birth_time, particle.lifetime, particle.size
        return _row(getattr(particle, name)) or _NOTHING

    def _points(self, parent: Any, name: str) -> np.ndarray | None:
        """(n, 4) f4, the attribute of the points that `parent` instances on; None without it."""
        key = parent.as_pointer(), name
        if key not in self._of_points:
            self._of_points[key] = _instance_attribute(parent, name)
        return self._of_points[key]


def _outermost(numbers: Iterable[int]) -> int:
    """Of an instance's persistent numbers, innermost first, that among the instances of its parent; -1 without any."""
    used = [number for number in numbers if number != _UNUSED]
    return used[-1] if used else -1


def _first(owners: Iterable[Any], name: str) -> Row:
    """The property of that name of the first one that has it."""
    return next((value for owner in owners if owner and (value := _property(owner, name))), _NOTHING)


def _property(owner: Any, name: str) -> Row | None:
    value = owner.get(name) if hasattr(owner, "get") else None
    if value is None:
        try:
            value = owner.path_resolve(name)
        except (ValueError, TypeError, AttributeError, IndexError, KeyError):
            return None
    return _row(value)


def _row(value: Any) -> Row | None:
    """A number as grey, up to four of them as a colour; None for all else."""
    if isinstance(value, (bool, int, float)):
        return float(value), float(value), float(value), 1.0
    if isinstance(value, str) or not hasattr(value, "__len__") or not 1 <= len(value) <= 4:
        return None
    try:
        r, g, b, a = (*map(float, value), *(0.0, 0.0, 0.0, 1.0)[len(value):])
    except (TypeError, ValueError):
        return None
    return r, g, b, a


def _instance_attribute(parent: Any, name: str) -> np.ndarray | None:
    """What geometry nodes left on the instances of `parent`; older versions of Blender do not tell."""
    if not hasattr(parent, "evaluated_geometry"):
        return None
    geometry = parent.evaluated_geometry()  # what it gives lives as long as it does
    points = geometry.instances_pointcloud()
    attribute = points.attributes.get(name) if points else None
    if attribute is None or attribute.data_type not in _KINDS:
        return None
    item, width = _KINDS[attribute.data_type]
    values = np.zeros(len(attribute.data) * width, "?" if attribute.data_type == "BOOLEAN" else "f4")
    attribute.data.foreach_get(item, values)
    values = values.reshape(-1, width).astype("f4")
    if width == 1:
        values = np.repeat(values, 3, 1)
    rows = np.ones((len(values), 4), "f4")
    rows[:, :values.shape[1]] = values
    return rows


_KINDS = {"FLOAT": ("value", 1), "INT": ("value", 1), "BOOLEAN": ("value", 1), "FLOAT_VECTOR": ("vector", 3),
          "FLOAT_COLOR": ("color", 4), "BYTE_COLOR": ("color", 4)}
