# SPDX-License-Identifier: GPL-3.0-or-later
"""Voxels -> LitVoxels: direct light in every occupied voxel, then mip levels for the cones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..gpu.cube import Cube
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..scene.types import View
from ..settings import RenderSettings
from .upload.lamps import Lamps
from .voxelize import Voxels

INJECT = Pass("light/inject.comp.glsl")
MIP = Pass("light/mip.comp.glsl")


@dataclass(frozen=True, eq=False)
class LitVoxels:
    """radiance: rgb outgoing radiance times opacity, a opacity, with mip levels."""

    scope: GpuScope
    voxels: Voxels
    radiance: Cube


class Injection(NamedTuple):
    """The settings of this stage, and no others: whatever else changes, the light in the voxels stays.

    eye  metres relative to the scene's centre; the origin when no highlight is stored, since nothing else depends on it
    """

    points: int
    ambient: float
    specular: float
    shininess: float
    eye: tuple[float, float, float]


def injection_of(settings: RenderSettings, lamps: Lamps, view: View) -> Injection:
    """The part of the settings and the view that the light in the voxels depends on."""
    eye = view.world_from_view[:3, 3] - lamps.centre_ws if settings.injection_specular else np.zeros(3)
    return Injection(settings.injection_samples, settings.injection_ambient, settings.injection_specular,
                     settings.injection_shininess, (float(eye[0]), float(eye[1]), float(eye[2])))


def light(device: Device, lamps: Lamps, voxels: Voxels, injection: Injection) -> LitVoxels:
    """Light the voxels."""
    scope = device.scope()
    radiance = scope.cube("radiance", voxels.grid.n)
    device.dispatch(INJECT, voxels.n_voxels, Occupancy=voxels.occupancy, Voxels=voxels.voxels,
                    Lights=lamps.rows, **lamps.nodes(), u_n_lights=len(lamps.lights),
                    u_n_points=injection.points, u_radiance=(radiance, 0), **voxels.grid.uniforms(),
                    u_eye=injection.eye, u_ambient=injection.ambient, u_specular=injection.specular,
                    u_shininess=injection.shininess)
    build_levels(device, radiance)
    return LitVoxels(scope, voxels, radiance)


def build_levels(device: Device, cube: Cube) -> None:
    """Fill the mip levels of a cube from its level 0, each texel the mean of eight."""
    for level in range(1, cube.n_levels):
        n = cube.n >> level
        device.dispatch(MIP, n**3, u_fine=(cube, level - 1), u_coarse=(cube, level), u_n=n)
