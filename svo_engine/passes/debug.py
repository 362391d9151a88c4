# SPDX-License-Identifier: GPL-3.0-or-later
"""LightCache or Voxels -> Film: the surfels, or the voxels at any mip level, themselves, showing what they hold."""

from __future__ import annotations

from dataclasses import dataclass

from ..gpu.cube import Cube
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..settings import RenderSettings
from .cache import LightCache
from .light import build_levels
from .parts import EYE, Part, Parts
from .raster import Eye
from .resolve import GpuFilm
from .voxelize import Grid, Voxels

ATTRIBUTE = Pass("debug/attribute.comp.glsl")
VOXELS = Pass("debug/voxels.comp.glsl")
SURFELS = Pass("debug/surfels.comp.glsl")


@dataclass(frozen=True, eq=False)
class Attribute:
    """values: rgb value times opacity, a opacity, with mip levels."""

    scope: GpuScope
    values: Cube


def make_attribute(device: Device, voxels: Voxels, show_normal: bool) -> Attribute:
    """The voxels' normals, or their albedo."""
    scope = device.scope()
    values = scope.cube("attribute", voxels.grid.n)
    device.dispatch(ATTRIBUTE, voxels.n_voxels, Voxels=voxels.voxels, u_attribute=(values, 0),
                    u_show_normal=show_normal)
    build_levels(device, values)
    return Attribute(scope, values)


def show_voxels(device: Device, grid: Grid, values: Cube, eye: Eye, settings: RenderSettings, film: GpuFilm,
                n: int) -> None:
    """Add one sample of n pixels to `film`: the first filled texel of the asked mip level of `values` on each ray."""
    lod = min(settings.view_lod, grid.n.bit_length() - 1)
    device.dispatch(VOXELS, n, u_attribute=values, u_film=film.sums, **eye.camera(), **grid.uniforms(), **film.layers(),
                    u_lod=lod, u_shade_faces=settings.view == "voxel_albedo",
                    u_show_opacity=settings.view == "voxel_coverage")


def show_surfels(device: Device, cache: LightCache, eye: Eye, parts: Parts, part: Part, settings: RenderSettings,
                 film: GpuFilm) -> None:
    """Add one part of a sample to `film`: of each pixel's surface the surfel, its light or its albedo."""
    device.dispatch(SURFELS, part.n, **cache.resources(), **cache.colors.resources(), **eye.pixels(part),
                    **parts.of(part, EYE), **film.layers(), u_film=film.sums,
                    u_show_albedo=settings.view == "cache_albedo")
