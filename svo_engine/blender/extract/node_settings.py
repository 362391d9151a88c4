# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of nodes and of the datablocks that have them, as plain values for scene/graph.py."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...scene.graph import Plain

# What of Blender's settings says how a tree is meant
_OF_OWNER = ("displacement_method", "use_transparent_shadow", "use_bump_map_correction", "max_vertex_displacement")
_OF_CYCLES = ("displacement_method", "use_transparent_shadow", "use_bump_map_correction", "emission_sampling",
              "volume_sampling", "volume_interpolation", "volume_step_rate", "volume_step_size", "sampling_method",
              "sample_map_resolution", "use_multiple_importance_sampling", "cast_shadow", "max_bounces", "is_portal",
              "is_caustics_light")
_RAYS = ("camera", "diffuse", "glossy", "transmission", "scatter", "shadow")

_NOT_READ = {"color_mapping", "bytecode", "bytecode_hash", "use_auto_update"}
_MAPPED = ("vector_type", "translation", "rotation", "scale", "mapping_x", "mapping_y", "mapping_z")
_IMAGE_USER = ("frame_current", "frame_duration", "frame_start", "frame_offset", "use_cyclic", "tile")

# Nodes that may name a file of text -> what holds it, as if it were a text block
_READ = {"ShaderNodeTexIES": "ies.text", "ShaderNodeScript": "script.text"}
_LARGEST_TEXT = 1 << 22

_MOVING = ("SEQUENCE", "MOVIE")

_SCALARS = {type(None), bool, int, float, str}

# Of curves, as many as Cycles takes
N_SAMPLES = 257


@cache
def _names(kind: Any) -> tuple[str, ...]:
    """The properties that nodes of a kind have more than all others have."""
    left_out = _NOT_READ.union(bpy.types.ShaderNode.bl_rna.properties.keys())
    return tuple(p.identifier for p in kind.bl_rna.properties if p.identifier not in left_out)


def settings_of_node(node: Any, groups: dict[str, Any]) -> dict[str, Plain]:
    """As Node has them. Groups that are named are added to `groups`."""
    made: dict[str, Plain] = {}
    kind: Any = type(node)
    for name in _names(kind):
        value = getattr(node, name, None)
        _set(made, name, value)
        if isinstance(value, bpy.types.NodeTree):
            groups.setdefault(value.name_full, value)
    if node.bl_idname in ("ShaderNodeRGB", "ShaderNodeValue", "ShaderNodeNormal"):  # their value is their output's
        made["value"] = plain(node.outputs[0].default_value)
    elif getattr(node, "mode", "") == "EXTERNAL" and node.bl_idname in _READ:
        made[_READ[node.bl_idname]] = _text_of(node)
    if made.get("image.source") not in _MOVING:  # else each frame would have another graph
        made.pop("image_user.frame_current", None)
    return made


def _text_of(node: Any) -> str | None:
    """What the file of a node holds; None if it cannot be read."""
    try:
        path = Path(bpy.path.abspath(node.filepath, library=node.id_data.library))
        return path.read_text(encoding="latin-1") if path.stat().st_size <= _LARGEST_TEXT else None
    except (OSError, ValueError):
        return None


def _set(made: dict[str, Plain], name: str, value: Any) -> None:
    """Add the property `name`; records with their own properties, datablocks with what of them is needed."""
    if type(value) in _SCALARS:
        made[name] = value
    elif isinstance(value, bpy.types.ColorRamp):
        stops = tuple((e.position, *e.color) for e in value.elements)
        made[name] = value.color_mode, value.interpolation, value.hue_interpolation, stops
    elif isinstance(value, bpy.types.CurveMapping):
        made[name], made[f"{name}.samples"] = _curves(value)
    elif isinstance(value, bpy.types.TexMapping):
        made.update({f"{name}.{part}": plain(getattr(value, part)) for part in _MAPPED})
    elif isinstance(value, bpy.types.ImageUser):
        made.update({f"{name}.{part}": plain(getattr(value, part)) for part in _IMAGE_USER})
    else:
        made[name] = plain(value)
        if isinstance(value, bpy.types.Image):
            made[f"{name}.source"] = value.source
        elif isinstance(value, bpy.types.Object):
            made[f"{name}.matrix_world"] = tuple(x for row in value.matrix_world for x in row)
        elif isinstance(value, bpy.types.Text):
            made[f"{name}.text"] = value.as_string()


def _curves(mapping: Any) -> tuple[Plain, Plain]:
    """All curves' points, and their values at even steps. Evaluating is Blender's, with all kinds of handles."""
    mapping.initialize()
    clip = (mapping.clip_min_x, mapping.clip_min_y, mapping.clip_max_x, mapping.clip_max_y)
    points = tuple(tuple((*p.location, p.handle_type) for p in curve.points) for curve in mapping.curves)
    levels = tuple(mapping.black_level), tuple(mapping.white_level)
    return (mapping.extend, clip if mapping.use_clip else None, *levels, points), _samples(mapping, points)


def _samples(mapping: Any, points: Plain) -> tuple[tuple[float, ...], ...]:
    """Of each curve but a fourth one, which all others come after, its values at even steps."""
    plain = [len(p) == 2 and all(x == y for x, y, _ in p) for p in points]
    first, last = np.float32(min(p[0][0] for p in points)), np.float32(max(p[-1][0] for p in points))
    steps = (first + np.arange(N_SAMPLES, dtype="f4") / np.float32(N_SAMPLES - 1) * (last - first)).tolist()
    if len(points) > 3:
        steps = [mapping.evaluate(mapping.curves[3], x) for x in steps]
    return tuple(() if all(plain) else tuple(mapping.evaluate(curve, x) for x in steps) for curve in mapping.curves[:3])


def plain(value: Any) -> Plain:
    """Numbers, strings and tuples as they are, a datablock's full name, None for all else."""
    if type(value) in _SCALARS:
        return value
    if isinstance(value, bpy.types.ID):
        return value.name_full
    return value[:] if hasattr(value, "__len__") else None


def settings_of_owner(owner: Any) -> dict[str, Plain]:
    """The settings of a material, world or lamp that say how its tree is meant, as far as this Blender has them."""
    cycles, rays = getattr(owner, "cycles", None), getattr(owner, "cycles_visibility", None)
    made = {name: plain(getattr(cycles, name)) for name in _OF_CYCLES if hasattr(cycles, name)}
    made.update({name: plain(getattr(owner, name)) for name in _OF_OWNER if hasattr(owner, name)})
    made.update({f"visible.{name}": bool(getattr(rays, name)) for name in _RAYS if hasattr(rays, name)})
    return made
