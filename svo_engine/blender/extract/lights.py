# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps: Blender's settings turned into radiometry."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ...scene import units
from ...scene.types import Color, Light
from .graphs import read_graph
from .nodes import fed_output, tree_of
from .reader import Reader
from .surfaces import surface


def read_light(lamp: Any, name: str, world_from_object: np.ndarray, warn: Callable[[str], object]) -> Light | None:
    """The lamp (an evaluated datablock) of the object `name`; None if it gives no light in Cycles either.

    world_from_object  (4, 4) f8, scale included
    """
    axes = world_from_object[:3, :3]
    scale = np.linalg.norm(axes, axis=0)
    common: dict[str, Any] = {"name": name, "world_from_light": _rigid(world_from_object, scale),
                              "casts_shadow": lamp.use_shadow, "graph": read_graph(tree_of(lamp), lamp)}
    factor = _factor(lamp, name, warn)
    color, normalize = _color(lamp, factor), getattr(lamp, "normalize", True)
    common["is_exact"] = factor is not None
    if lamp.type == "SUN":
        emitted = units.sun_irradiance(lamp.energy, color, lamp.angle, normalize)
        return Light(kind="SUN", emitted=emitted, angle=lamp.angle, **common)
    if lamp.type == "AREA":
        return _area(lamp, color, scale, normalize, common)
    common |= {"radius": lamp.shadow_soft_size, "soft_falloff": lamp.use_soft_falloff,
               "emitted": units.point_intensity(lamp.energy, color, lamp.shadow_soft_size, normalize)}
    if lamp.type == "POINT":
        return Light(kind="POINT", **common)
    return Light(kind="SPOT", spot_angle=_spot_angle(lamp, scale, name, warn), spot_blend=lamp.spot_blend, **common)


def _area(lamp: Any, color: Color, scale: np.ndarray, normalize: bool, common: dict[str, Any]) -> Light | None:
    """An area lamp, its size in the world; none if that is nothing, or if it only guides Cycles to a window."""
    is_ellipse, is_square = lamp.shape in ("DISK", "ELLIPSE"), lamp.shape in ("SQUARE", "DISK")
    size = float(lamp.size * scale[0]), float((lamp.size if is_square else lamp.size_y) * scale[1])
    area = units.area_of(size, is_ellipse)
    if area == 0 or (hasattr(lamp, "cycles") and lamp.cycles.is_portal):
        return None
    return Light(kind="AREA", emitted=units.area_radiance(lamp.energy, color, area, normalize), size=size,
                 is_ellipse=is_ellipse, spread=min(lamp.spread, math.pi), **common)


def _spot_angle(lamp: Any, scale: np.ndarray, name: str, warn: Callable[[str], object]) -> float:
    """Full angle [rad] of a spot's cone, which the object's scale can widen or make an ellipse."""
    if math.isclose(scale.min(), scale.max(), rel_tol=1e-4) or scale[2] == 0:
        return float(lamp.spot_size)
    if not math.isclose(scale[0], scale[1], rel_tol=1e-4):
        warn(f"Light '{name}': a spot scaled to an ellipse is not supported; a circle of the same area is used")
    widening = math.sqrt(scale[0] * scale[1]) / scale[2]
    return 2 * math.atan(math.tan(min(lamp.spot_size / 2, math.pi / 2)) * widening)


def _factor(lamp: Any, name: str, warn: Callable[[str], object]) -> Color | None:
    """What the lamp's nodes make of its colour; None if only their compiled tree can say it."""
    tree = tree_of(lamp)
    if tree is None:
        return 1.0, 1.0, 1.0
    reader = Reader(f"Light '{name}'", None, warn, tells_guesses=False)
    emission = surface(reader, fed_output(tree, "Surface")).emission
    return emission if reader.is_exact else None


def _color(lamp: Any, factor: Color | None) -> Color:
    """Colour times temperature times exposure times what the lamp's nodes say, if they are constant."""
    r, g, b = lamp.color
    color = np.array((r, g, b)) * 2.0 ** getattr(lamp, "exposure", 0.0)
    if getattr(lamp, "use_temperature", False):
        color = color * lamp.temperature_color
    if factor is not None:
        color = color * factor
    r, g, b = color.tolist()
    return r, g, b


def _rigid(matrix: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Rotation and translation of `matrix`: its -Z is where the lamp shines to, also if a negative scale mirrors it."""
    rigid = np.eye(4)
    rigid[:3, 3] = matrix[:3, 3]
    if scale.min() > 0:
        z, x = matrix[:3, 2] / scale[2], matrix[:3, 0] / scale[0]
        y = np.cross(z, x)
        rigid[:3, 1] = y / np.linalg.norm(y)
        rigid[:3, 0], rigid[:3, 2] = np.cross(rigid[:3, 1], z), z
    return rigid
