# SPDX-License-Identifier: GPL-3.0-or-later
"""What node trees ask for of meshes and instances: attributes by name, random numbers, colours, coordinates."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...gpu.words import WIDTH
from ...scene import layouts
from ...scene.geometry import REST
from ...scene.named import named_attribute
from ...scene.types import Attribute, Instances, Mesh, View
from .placing import Placing

_DOMAINS = {"POINT": "ATTRIBUTE_POINT", "FACE": "ATTRIBUTE_FACE", "CORNER": "ATTRIBUTE_CORNER",
            "INSTANCE": "ATTRIBUTE_INSTANCE"}


@dataclass(frozen=True, eq=False)
class Shading:
    """read: what bind/attributes.glsl reads."""

    scope: GpuScope
    read: Resources


def upload_shading(device: Device, placing: Placing, meshes: tuple[Mesh, ...], instances: Instances,
                   names: tuple[Hashable, ...] | None) -> Shading:
    """Copy the attributes of these names, and numbers of instances; nothing if there is no tree to ask for them."""
    scope = device.scope()
    if names is None:
        empty = scope.buffer("shown instances", 0)
        return Shading(scope, {"ShownInstances": empty, "u_attributes": scope.words("attributes", 0)})
    rows, parts, n_words = _attributes(placing, meshes, instances, names)
    rests = np.full(len(meshes), layouts.CONSTANTS["NO_REST"], "u4")
    for m, mesh in enumerate(meshes):
        if (rest := mesh.attribute(REST)) is not None:
            start = -(-n_words // WIDTH) * WIDTH
            parts.append((start, np.ascontiguousarray(rest.values).ravel().view("u4")))
            rests[m], n_words = (start - 3 * int(placing.shapes.first_vertex[m])) % 2**32, start + rest.values.size
    words = scope.words("attributes", n_words)
    words.put(0, rows.ravel())
    for first, values in parts:
        words.put(first, values)
    shown = scope.buffer("shown instances", _shown(placing, meshes, instances, len(names), rests))
    return Shading(scope, {"ShownInstances": shown, "u_attributes": words})


def _attributes(placing: Placing, meshes: tuple[Mesh, ...], instances: Instances, names: tuple[Hashable, ...],
                ) -> tuple[np.ndarray, list[tuple[int, np.ndarray]], int]:
    """(rows (n_meshes n_names, 2) u4, where values begin and the values (n,) u4, words in all)."""
    rows = np.zeros((len(meshes) * len(names), 2), "u4")
    parts: list[tuple[int, np.ndarray]] = []
    starts: dict[int, int] = {}
    end = rows.size
    for m, mesh in enumerate(meshes):
        for k, name in enumerate(names):
            found = named_attribute(mesh, instances, name)
            if found is None or not len(found.values):
                continue
            if id(found) not in starts:
                starts[id(found)] = -(-end // WIDTH) * WIDTH
                parts.append((starts[id(found)], np.ascontiguousarray(found.values).ravel().view("u4")))
                end = starts[id(found)] + found.values.size
            width = found.values.shape[1]
            first = starts[id(found)] - width * _first_element(placing, m, found)
            rows[m * len(names) + k] = first % 2**32, layouts.CONSTANTS[_DOMAINS[found.domain]] << 3 | width
    return rows, parts, max(end, 2)


def _first_element(placing: Placing, m: int, attribute: Attribute) -> int:
    """How elements of the attribute's domain are counted at the beginning of mesh m."""
    shapes = placing.shapes
    return {"POINT": int(shapes.first_vertex[m]), "FACE": int(shapes.first_triangle[m]),
            "CORNER": 3 * int(shapes.first_triangle[m]), "INSTANCE": 0}[attribute.domain]


def _shown(placing: Placing, meshes: tuple[Mesh, ...], instances: Instances, n_names: int,
           rests: np.ndarray) -> np.ndarray:
    """Rows of layout SHOWN, in the device's order."""
    rows = np.zeros(len(instances), layouts.dtype(layouts.SHOWN))
    if len(instances):
        lows, sizes = (np.array([getattr(m, f"generated_{what}") for m in meshes], "f4") for what in ("low", "size"))
        order, mesh = placing.order, instances.mesh[placing.order]
        rows["low"], rows["size"], rows["first_row"], rows["number"] = lows[mesh], sizes[mesh], mesh * n_names, order
        rows["rest"] = rests[mesh]
        for name in ("random", "object_index", "color", "generated", "uv"):
            if len(values := getattr(instances, name)):
                rows[name] = values[order]
    return rows


def view_uniforms(view: View | None, centre_ws: np.ndarray) -> Resources:
    """What camera and window coordinates are made by; without a view that of a camera at the origin."""
    world_from_view = np.eye(4) if view is None else view.world_from_view.copy()
    world_from_view[:3, 3] -= centre_ws
    return {"u_view_from_world": np.linalg.inv(world_from_view),
            "u_clip_from_view": np.eye(4) if view is None else view.clip_from_view}
