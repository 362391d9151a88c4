# SPDX-License-Identifier: GPL-3.0-or-later
"""LightCache or Voxels -> Film: the surfels, or the voxels at any mip level, themselves, showing what they hold."""

from __future__ import annotations

from dataclasses import dataclass

from ..gpu.cube import Cube
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..settings import RenderSettings
from .cache import CACHE, CACHE_UNIFORMS, LightCache
from .gather import CAMERA
from .light import build_levels
from .raster import GBuffer
from .resolve import GpuFilm
from .upload import GpuScene
from .voxelize import GEOMETRY, GRID, MATERIALS, Grid, Voxels

ATTRIBUTE = Pass(("debug/attribute.comp.glsl",), ("Voxels",), images=("u_attribute",))
VOXELS = Pass(("debug/voxels.comp.glsl",), textures=("u_attribute",), images=("u_film",),
              uniforms=(*CAMERA, *GRID, "u_lod"))
SURFELS = Pass(("debug/surfels.comp.glsl",), (*GEOMETRY, *MATERIALS, *CACHE), textures=("u_visibility",),
               images=("u_film",), uniforms=(*CAMERA, *CACHE_UNIFORMS))


@dataclass(frozen=True, eq=False)
class Attribute:
    """values: rgb value times opacity, a opacity, with mip levels."""

    scope: GpuScope
    values: Cube


def make_attribute(device: Device, voxels: Voxels, show_normal: bool) -> Attribute:
    """The voxels' normals, or their albedo."""
    scope = device.scope()
    values = scope.cube("attribute", voxels.grid.n)
    device.dispatch(ATTRIBUTE, voxels.n_voxels, {"SHOW_NORMAL": show_normal}, Voxels=voxels.voxels,
                    u_attribute=(values, 0))
    build_levels(device, values)
    return Attribute(scope, values)


def show_voxels(device: Device, grid: Grid, values: Cube, gbuffer: GBuffer, settings: RenderSettings,
                film: GpuFilm) -> None:
    """Add one sample to `film`: the first filled texel of the asked mip level of `values` along each pixel's ray."""
    lod = min(settings.view_lod, grid.n.bit_length() - 1)
    constants = {"SHADE_FACES": settings.view == "voxel_albedo", "SHOW_OPACITY": settings.view == "voxel_coverage"}
    device.dispatch(VOXELS, gbuffer.n_invocations, constants, u_attribute=values, u_film=film.sums,
                    **gbuffer.camera(), **grid.uniforms(), u_lod=lod)
    film.n_samples += 1


def show_surfels(device: Device, gpu_scene: GpuScene, cache: LightCache, gbuffer: GBuffer, settings: RenderSettings,
                 film: GpuFilm) -> None:
    """Add one sample to `film`: of each pixel's surface the surfel, its light or its albedo."""
    device.dispatch(SURFELS, gbuffer.n_invocations, {"SHOW_ALBEDO": settings.view == "cache_albedo"},
                    **gpu_scene.geometry, **gpu_scene.materials, **cache.resources(), **gbuffer.uniforms(),
                    u_film=film.sums)
    film.n_samples += 1
