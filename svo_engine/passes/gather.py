# SPDX-License-Identifier: GPL-3.0-or-later
"""Points -> arrivals: the light that arrives at what the eye sees, by rays or by cones."""

from __future__ import annotations

from math import tan

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..settings import RenderSettings
from .cache import LightCache
from .evaluate import all_slots
from .light import LitVoxels
from .lights import Lights
from .parts import EYE, Part, Parts
from .path import follow_paths
from .raster import Eye
from .tracer import Tracer
from .upload import GpuScene

CONES = Pass("gather/cones.comp.glsl")
RAYS = Pass("gather/rays.comp.glsl")
FOUND = Pass("gather/found.comp.glsl")
DRAW = Pass("lights/draw.comp.glsl")


def gather_cones(device: Device, gpu_scene: GpuScene, lit: LitVoxels, eye: Eye, parts: Parts, part: Part,
                 settings: RenderSettings) -> None:
    """Fill in the light of one part by cone tracing."""
    grid = lit.voxels.grid
    device.dispatch(
        CONES, part.n, **gpu_scene.placing.instances, **gpu_scene.materials, **gpu_scene.world(), **eye.pixels(part),
        **grid.uniforms(), **parts.of(part, EYE), Lights=gpu_scene.lamps.rows,
        **gpu_scene.lamps.nodes(), u_albedo=gpu_scene.table.table,
        u_radiance=lit.radiance, u_n_lights=len(gpu_scene.lamps.lights), u_has_light=gpu_scene.needs.light,
        u_has_gloss=gpu_scene.needs.gloss, u_gloss=parts.planes["gloss"], u_cone_offset=settings.cone_offset,
        u_cone_step=settings.cone_step, u_cone_distance=settings.cone_distance * grid.n, u_sample=eye.sample,
        u_seed=settings.seed, u_ring_angle=settings.cone_ring_angle,
        u_tan_half_aperture=tan(settings.cone_aperture / 2), u_tan_half_shadow=tan(settings.shadow_aperture / 2),
        u_specular_cone=settings.specular_cone)


def gather_rays(device: Device, gpu_scene: GpuScene, cache: LightCache, tracer: Tracer, lights: Lights, eye: Eye,
                parts: Parts, part: Part, settings: RenderSettings) -> None:
    """Fill in the light of one part by rays: diffuse light, then what mirrors and glass show."""
    needs, wave = gpu_scene.needs, parts.of(part, EYE)
    n_rays = settings.gather_rays * needs.light
    if lights.has_emitters(needs):
        device.dispatch(DRAW, part.n, **gpu_scene.geometry, **gpu_scene.emission.read, **wave,
                        **all_slots(parts, part), **lights.emitters(), u_seed_offset=0)
    ends = {"u_n_rays": n_rays, "u_ends": parts.planes["ends"]}
    device.dispatch(
        RAYS, part.n, tracer.constants(), **{**tracer.resources(), **gpu_scene.geometry}, **lights.resources(),
        **gpu_scene.world(), **cache.resources(), **wave, **ends,
        u_n_facing=1 + needs.glass, u_keeps_draws=needs.gloss, u_keeps_ends=needs.emission)
    if needs.emission and n_rays:
        device.dispatch(FOUND, part.n, **gpu_scene.geometry, **gpu_scene.emission.read, **lights.emitters(), **wave,
                        **ends)
    if needs.gloss:
        follow_paths(device, gpu_scene, cache, tracer, lights, eye, parts, part)
    device.profiler.counts["diffuse rays"] += part.n * n_rays
    device.profiler.counts["light draws"] += part.n * lights.n_draws
