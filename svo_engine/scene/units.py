# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's lamp watts turned into radiometry, so that the same file gives the same brightness as Cycles.

Blender's watt is the radiant flux of a lamp that sends as much into every direction as this one does along its axis;
a spot of P watts is therefore as bright inside its cone as a point of P watts. Checked against Cycles in
`tests/blender/test_radiometry.py`.
"""

from __future__ import annotations

import math

from .types import Color


def point_intensity(watts: float, color: Color, radius: float = 0.0, normalize: bool = True) -> Color:
    """Radiant intensity I [W sr^-1] of a point or spot lamp.

    A sphere of radius r that radiates L everywhere has the flux phi = 4 pi r^2 * pi L and, seen from afar, the
    intensity I = pi r^2 L = phi / (4 pi), whatever its radius. Not normalised (Blender 4.5+), the watts stand for pi
    times the radiance of the sphere's surface [W m^-2]: I = watts * r^2. A point has no surface; Cycles then takes
    the sphere of 4 m^2: I = watts / pi.
    """
    if normalize:
        return _scaled(color, watts / (4 * math.pi))
    return _scaled(color, watts * radius * radius if radius > 0 else watts / math.pi)


def sun_irradiance(strength: float, color: Color, angle: float = 0.0, normalize: bool = True) -> Color:
    """Irradiance E [W m^-2] of a surface that faces a sun of angular diameter `angle` [rad].

    Blender's strength is just that, whatever the angle. Not normalised (Blender 4.5+), it is the radiance of the
    disk, whose projected solid angle is pi sin^2(angle / 2); at angle 0 there is no disk and it stays the irradiance.
    """
    return _scaled(color, strength if normalize or angle == 0 else strength * math.pi * math.sin(angle / 2) ** 2)


def area_radiance(watts: float, color: Color, area: float, normalize: bool = True) -> Color:
    """Radiance L [W m^-2 sr^-1] of a one-sided Lambertian lamp of `area` [m^2]: phi = pi L A, so L = phi / (pi A).

    Not normalised, the watts are the radiant exitance M = pi L [W m^-2].
    """
    return _scaled(color, watts / (math.pi * (area if normalize else 1.0)))


def area_of(size: tuple[float, float], is_ellipse: bool) -> float:
    """Area [m^2] of a rectangle of `size` metres, or of the ellipse inside it."""
    return size[0] * size[1] * (math.pi / 4 if is_ellipse else 1.0)


def _scaled(color: Color, factor: float) -> Color:
    return (color[0] * factor, color[1] * factor, color[2] * factor)
