# SPDX-License-Identifier: GPL-3.0-or-later
"""GBuffer and LitVoxels or LightCache -> Incident: the light that arrives at each pixel, by cones or by rays."""

from __future__ import annotations

from dataclasses import dataclass
from math import tan
from typing import Any

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..settings import RenderSettings
from .bvh import TRACE, TRACE_UNIFORMS, Bvh
from .cache import CACHE, CACHE_UNIFORMS, WORLD, LightCache
from .light import LitVoxels
from .lights import LIGHT_TEXTURES, LIGHT_UNIFORMS, LIGHTS, Lights
from .raster import GBuffer
from .upload import GpuScene
from .voxelize import GEOMETRY, GRID, MATERIALS

CAMERA = ("u_ray_origin", "u_ray_direction", "u_size")
KINDS = ("DIFFUSE_DIRECT", "DIFFUSE_INDIRECT", "DIFFUSE_FOUND", "GLOSSY_DIRECT", "GLOSSY_INDIRECT",
         "TRANSMISSION_DIRECT", "TRANSMISSION_INDIRECT")  # of light, see bind/incident.glsl

CONES = Pass(("gather/cones.comp.glsl",), (*GEOMETRY, *MATERIALS, "Lights"),
             textures=("u_visibility", "u_tiles", "u_env", "u_radiance", "u_albedo"), images=("u_incident",),
             uniforms=(*CAMERA, *WORLD, *GRID, "u_cone_offset", "u_cone_step", "u_cone_distance", "u_sample", "u_seed",
                       "u_ring_angle", "u_tan_half_aperture", "u_tan_half_shadow", "u_specular_cone"))

RAYS = Pass(("gather/rays.comp.glsl",), (*GEOMETRY, *MATERIALS, *CACHE, *LIGHTS),
            textures=("u_visibility", "u_tiles", "u_env", "u_albedo", *TRACE, *LIGHT_TEXTURES),
            images=("u_incident",),
            uniforms=(*CAMERA, *WORLD, *CACHE_UNIFORMS, *TRACE_UNIFORMS, *LIGHT_UNIFORMS, "u_sample",
                      "u_n_samples", "u_seed"))

MOST = 1024  # samples that get numbers of a pixel's own; past them it goes on with its neighbours'


@dataclass(frozen=True, eq=False)
class Incident:
    """layers: a texture f4 for each of the `kinds` of light."""

    scope: GpuScope
    kinds: tuple[str, ...]
    layers: Any

    def constants(self) -> dict[str, int]:
        """The constants of bind/incident.glsl."""
        return {f"INCIDENT_{kind}": self.kinds.index(kind) if kind in self.kinds else -1 for kind in KINDS}


def make_incident(device: Device, size: tuple[int, int], has_specular: bool, is_told_apart: bool) -> Incident:
    """Textures for pictures of `size` pixels; is_told_apart: whether it matters which indirect light met an emitter."""
    scope = device.scope()
    kinds = tuple(kind for kind in KINDS
                  if (is_told_apart if kind == "DIFFUSE_FOUND" else has_specular or kind.startswith("DIFFUSE")))
    return Incident(scope, kinds, scope.layers("incident", size, len(kinds)))


def gather_cones(device: Device, gpu_scene: GpuScene, lit: LitVoxels, gbuffer: GBuffer, incident: Incident,
                 settings: RenderSettings, sample: int) -> None:
    """Fill `incident` for one sample by cone tracing."""
    grid = lit.voxels.grid
    constants = {"N_LIGHTS": len(gpu_scene.scene.lights), "HAS_TEXTURES": gpu_scene.has_textures,
                 "HAS_INDIRECT": gpu_scene.has_light, "HAS_SPECULAR": gpu_scene.has_specular,
                 **incident.constants(), **gbuffer.constants()}
    device.dispatch(
        CONES, gbuffer.n_invocations, constants, **gpu_scene.geometry, **gpu_scene.materials, **gpu_scene.world(),
        **gbuffer.uniforms(), **grid.uniforms(), u_tiles=gbuffer.tiles, u_incident=incident.layers,
        Lights=gpu_scene.lights, u_albedo=gpu_scene.albedo, u_radiance=lit.radiance, u_cone_offset=settings.cone_offset,
        u_cone_step=settings.cone_step, u_cone_distance=settings.cone_distance * grid.n, u_sample=sample,
        u_seed=settings.seed, u_ring_angle=settings.cone_ring_angle,
        u_tan_half_aperture=tan(settings.cone_aperture / 2), u_tan_half_shadow=tan(settings.shadow_aperture / 2),
        u_specular_cone=settings.specular_cone)


def gather_rays(device: Device, gpu_scene: GpuScene, cache: LightCache, bvh: Bvh, lights: Lights, gbuffer: GBuffer,
                incident: Incident, settings: RenderSettings, sample: int) -> None:
    """Fill `incident` for one sample by rays."""
    constants = {**gpu_scene.surface_constants(), "HAS_INDIRECT": gpu_scene.has_light,
                 "HAS_ALPHA": gpu_scene.has_alpha, "N_RAYS": settings.gather_rays, **incident.constants(),
                 **gbuffer.constants(), **bvh.constants(), **lights.constants()}
    device.dispatch(
        RAYS, gbuffer.n_invocations, constants, **gpu_scene.geometry, **gpu_scene.materials, **gpu_scene.world(),
        **gbuffer.uniforms(), **cache.resources(), **bvh.resources(), **lights.resources(), u_tiles=gbuffer.tiles,
        u_incident=incident.layers, u_albedo=gpu_scene.albedo, u_sample=sample,
        u_n_samples=1 << min(settings.samples - 1, MOST - 1).bit_length(), u_seed=settings.seed)
    width, height = gbuffer.targets.size
    device.profiler.counts["diffuse rays"] += width * height * settings.gather_rays
    device.profiler.counts["light draws"] += width * height * lights.n_draws
