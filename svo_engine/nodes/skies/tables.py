# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of a Sky Texture -> the table of its sky, and its sun's disc."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from . import multiple, single
from .hosek import hosek

WIDE = 256  # columns of a table, half a turn: the other half is its mirror image
SMALLEST = 0.0005  # radians: the sun's least size
DARK = 2.5  # sine of the elevation below the horizon, times which the ground fades to black
XYZ_TO_RGB = np.array(((3.2409699, -1.5373832, -0.4986108), (-0.9692436, 1.8759675, 0.0415551),
                       (0.0556301, -0.2039770, 1.0569715)))  # Rec. 709


@dataclass(frozen=True)
class Sun:
    """Where Blender's sun is: radians; elevation from -pi/2 to pi/2, rotation from +Y towards +X."""

    elevation: float
    rotation: float

    @property
    def direction(self) -> np.ndarray:
        """(3,) f8, unit, in the space of the node's vector."""
        across = np.cos(self.elevation)
        return np.array((across * np.sin(self.rotation), across * np.cos(self.rotation), np.sin(self.elevation)))


@dataclass(frozen=True)
class Disc:
    """What the sun's disc looks like.

    size     angular diameter, radians
    ends     CIE XYZ of its lowest and highest point, times the node's intensity; limb darkening comes on top
    horizon  radians of elevation below which it is hidden
    """

    sun: Sun
    size: float
    ends: tuple[tuple[float, ...], tuple[float, ...]]
    horizon: float


def sun_of(settings: Mapping[str, Any]) -> Sun:
    """The sun, wherever its angles have been turned to; of the daylight models its direction."""
    if settings["sky_type"] == "HOSEK_WILKIE":
        x, y, z = np.array(settings["sun_direction"]) / max(float(np.linalg.norm(settings["sun_direction"])), 1e-8)
        return Sun(float(np.arcsin(np.clip(z, -1, 1))), float(np.arctan2(x, y)))
    elevation, rotation = float(settings["sun_elevation"]), float(settings["sun_rotation"])
    elevation = (elevation + np.pi) % (2 * np.pi) - np.pi
    if abs(elevation) > np.pi / 2:
        elevation, rotation = float(np.copysign(np.pi, elevation)) - elevation, rotation + np.pi
    return Sun(elevation, rotation % (2 * np.pi))


def disc_of(settings: Mapping[str, Any]) -> Disc | None:
    """The sun's disc; None where it is switched off, or the model has none."""
    model = _model(settings)
    if model is None or not settings.get("sun_disc", True):
        return None
    where, size = sun_of(settings), max(float(settings["sun_size"]), SMALLEST)
    altitude, densities = _air(settings)
    ends = model.sun(where.elevation, size, altitude, densities) * float(settings["sun_intensity"])
    horizon = 0.0
    if model is multiple:
        horizon = float(np.arcsin(min(multiple.EARTH / (multiple.EARTH + altitude / 1000), 1.0)) - np.pi / 2)
    return Disc(where, size, (tuple(ends[0]), tuple(ends[1])), horizon)


def table_of(settings: Mapping[str, Any]) -> np.ndarray:
    """CIE XYZ (rows, WIDE, 3) f4 of a sky by scattering or by Hosek and Wilkie, without its sun's disc.

    Column x is (x + 1/2) / (2 WIDE) of a turn from where the sun is not. Rows of Blender 5's models: a row's share s of
    the whole, less 1/2, is half the root of the elevation's share of a right angle, with its sign; of Blender 4's:
    s is that root itself.
    """
    if settings["sky_type"] == "HOSEK_WILKIE":
        rows, azimuths = tuple(_rows(0.5).tolist()), tuple(_azimuths(0.5).tolist())
        return hosek(sun_of(settings).elevation, float(settings["turbidity"]), float(settings["ground_albedo"]), rows,
                     azimuths)
    altitude, densities = _air(settings)
    return _table(str(settings["sky_type"]), sun_of(settings).elevation, altitude, densities)


@lru_cache(maxsize=8)
def _table(kind: str, elevation: float, altitude: float, densities: tuple[float, float, float]) -> np.ndarray:
    if kind == "MULTIPLE_SCATTERING":
        return _square(multiple, 0.5, elevation, altitude, densities)
    if kind == "SINGLE_SCATTERING":
        return _over_black_ground(_square(single, 0.0, elevation, altitude, densities))
    rows = (np.pi / 2 + np.pi / 512) * (np.arange(128) / 128) ** 2
    return single.sky(rows, _azimuths(0.0), elevation, altitude, densities)


def _square(model: Any, offset: float, elevation: float, altitude: float,
            densities: tuple[float, float, float]) -> np.ndarray:
    """256 rows, pixels at their middle (offset 1/2) or at their corner. Single scattering begins at the horizon."""
    rows = _rows(offset)
    if model is single:
        rows = rows[128:]
    return model.sky(rows, _azimuths(offset), elevation, altitude, densities)


def _rows(offset: float) -> np.ndarray:
    """(256,) f8, radians above the horizon."""
    share = (np.arange(2 * 128) + offset) / 128 - 1
    rows: np.ndarray = np.copysign(share**2, share) * np.pi / 2
    return rows


def _over_black_ground(sky: np.ndarray) -> np.ndarray:
    """The same with 128 rows below it, which fade from the horizon to black."""
    down = np.sin(np.pi / 2 * (1 - np.arange(128) / 128) ** 2)
    fade = np.maximum(1 - DARK * down, 0) ** 3
    return np.concatenate([sky[0] * fade[:, None, None].astype("f4"), sky])


def _azimuths(offset: float) -> np.ndarray:
    """(WIDE,) f8, radians from the sun."""
    return (np.arange(WIDE) + offset) * np.pi / WIDE - np.pi


def _model(settings: Mapping[str, Any]) -> Any:
    kinds = {"NISHITA": single, "SINGLE_SCATTERING": single, "MULTIPLE_SCATTERING": multiple}
    return kinds.get(settings.get("sky_type", ""))


def _air(settings: Mapping[str, Any]) -> tuple[float, tuple[float, float, float]]:
    """Metres of altitude; densities of air, aerosols (called dust before Blender 5) and ozone."""
    aerosol = settings.get("aerosol_density", settings.get("dust_density", 1.0))
    densities = float(settings["air_density"]), float(aerosol), float(settings["ozone_density"])
    return float(settings["altitude"]), densities
