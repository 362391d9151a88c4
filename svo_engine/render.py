# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame: `render` reads from top to bottom as the picture in docs/architecture.md does from left to right."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

from .errors import GpuError
from .film import Film
from .gpu.device import Device
from .gpu.kept import Kept
from .gpu.thread import GpuThread
from .passes.adaptive import is_done, make_progress
from .passes.bvh import Bvh, build_bvh, build_meshes
from .passes.cache import LightCache, light_cache, link
from .passes.debug import make_attribute, show_surfels, show_voxels
from .passes.denoise import read_picture
from .passes.denoise.choice import make_denoiser, wanted
from .passes.gather import Incident, gather_cones, gather_rays, make_incident
from .passes.light import LitVoxels, injection_of, light
from .passes.lights import Lights, make_lights
from .passes.lights.glow import make_glow
from .passes.octree import Octree, build_octree
from .passes.planes import planes_for
from .passes.raster import GBuffer, make_targets, raster
from .passes.resolve import GpuFilm, make_film, resolve
from .passes.upload import GpuScene, assemble
from .passes.voxelize import Voxels, voxelize
from .scene.types import Scene, View
from .settings import RenderSettings

SMALLEST_CACHE = 32  # voxels a side

Stage = Callable[..., Any]
Gather = Callable[[GBuffer, Incident, int], None]


def render(scene: Scene, view: View, settings: RenderSettings, device: Device, kept: Kept) -> Iterator[GpuFilm]:
    """Yield the film after each sample; all in the device's own thread."""
    started = time.monotonic()
    sums = device.profiler.reset()
    with kept.frame(device) as stage, device.scope() as scope:
        with device.profiler.host("upload"):
            gpu_scene = assemble(scope, scene, stage)
        denoiser = stage("denoiser", make_denoiser, view.size, wanted(settings), settings.denoising_quality,
                         not gpu_scene.has_alpha)
        film = make_film(scope, view, planes_for(gpu_scene, settings, denoiser.name), gpu_scene.centre_ws,
                         make_progress(scope, view.size, settings), is_black=settings.view != "combined")
        film.denoiser = denoiser
        film.limits.extend(denoiser.limits)
        targets = stage("targets", make_targets, view.size)
        incident = stage("incident", make_incident, view.size, gpu_scene.has_specular, "DIFFUSE_FOUND" in film.planes)
        gather, show, bvh = None, None, None
        if settings.view.startswith("cache"):
            show = _cache_view(stage, device, gpu_scene, settings, film)
        elif settings.view != "combined":
            show = _voxel_view(stage, device, gpu_scene, view, settings)
        elif settings.method == "cones":
            gather = _cones(stage, device, gpu_scene, view, settings)
        else:
            bvh = _trees(stage, gpu_scene)
            gather = _rays(stage, device, gpu_scene, bvh, settings, film)
        for sample in range(settings.samples):
            gbuffer = film.gbuffer = raster(device, gpu_scene, view, targets, settings, sample, film.tiles, bvh)
            if gather:
                gather(gbuffer, incident, sample)
                resolve(device, gpu_scene, gbuffer, incident, film)
            elif show:
                show(gbuffer, film)
            is_late = 0 < settings.time_limit < time.monotonic() - started
            film.is_last = is_late or film.n_samples == settings.samples or is_done(device, film)
            yield film
            device.profiler.sums = sums  # other frames may have had a turn
            if film.is_last:
                return


# Stages by what they depend on, which is all that is compared: an edit redoes no more than it must


def _trees(stage: Stage, gpu_scene: GpuScene) -> Bvh:
    trees = stage("trees", build_meshes, gpu_scene.scene.meshes)
    return stage("bvh", lambda device, *_: build_bvh(device, gpu_scene, trees), trees, gpu_scene.placing)


def _lights(stage: Stage, gpu_scene: GpuScene) -> Lights:
    glow = stage("glow", lambda device, *_: make_glow(device, gpu_scene), gpu_scene.placing, gpu_scene.surfaces,
                 gpu_scene.sky, gpu_scene.scene.world)
    return stage("lights", lambda device, *_: make_lights(device, gpu_scene, glow), gpu_scene.lamps, glow)


def _octree(stage: Stage, gpu_scene: GpuScene, n: int) -> Octree:
    return stage("octree", lambda device, *_: build_octree(device, gpu_scene, n), gpu_scene.placing,
                 gpu_scene.surfaces, n)


def _cache(stage: Stage, gpu_scene: GpuScene, octree: Octree, bvh: Bvh, lights: Lights,
           settings: RenderSettings) -> LightCache:
    amounts = settings.cache_rays, settings.injection_samples
    links = stage("links", lambda device, *_: link(device, gpu_scene, octree, bvh, lights, *amounts), octree, bvh,
                  lights.glow, gpu_scene.scene.world, amounts)
    return stage("cache", lambda device, *_: light_cache(device, gpu_scene, links, bvh, lights, settings.bounces),
                 links, lights, settings.bounces)


def _voxels(stage: Stage, gpu_scene: GpuScene, settings: RenderSettings) -> Voxels:
    n = int(settings.resolution)
    return stage("voxelize", lambda device, *_: voxelize(device, gpu_scene, n), gpu_scene.placing,
                 gpu_scene.surfaces, n)


def _lit(stage: Stage, gpu_scene: GpuScene, voxels: Voxels, view: View, settings: RenderSettings) -> LitVoxels:
    injection = injection_of(settings, gpu_scene, view)
    return stage("light", lambda device, *_: light(device, gpu_scene, voxels, injection), voxels, gpu_scene.lamps,
                 gpu_scene.surfaces, injection)


def _cones(stage: Stage, device: Device, gpu_scene: GpuScene, view: View, settings: RenderSettings) -> Gather:
    """Light in filtered voxels, gathered by cones: the thesis's way."""
    voxels = _voxels(stage, gpu_scene, settings)
    lit = _lit(stage, gpu_scene, voxels, view, settings)
    device.profiler.counts["voxels"] = voxels.n_voxels
    return lambda gbuffer, incident, sample: gather_cones(device, gpu_scene, lit, gbuffer, incident, settings,
                                                          sample)


def _rays(stage: Stage, device: Device, gpu_scene: GpuScene, bvh: Bvh, settings: RenderSettings,
          film: GpuFilm) -> Gather:
    """Light on the surfaces in an octree, gathered by rays with exact hits."""
    lights = _lights(stage, gpu_scene)
    cache = film.cache = _fitting_cache(stage, gpu_scene, bvh, lights, settings, film.limits)
    octree = cache.octree
    device.profiler.counts.update({"nodes": octree.n_nodes, "surfels": octree.n_surfels, **lights.counts(),
                                   "octree bytes": octree.n_bytes, "dense bytes": octree.n_dense_bytes})
    return lambda gbuffer, incident, sample: gather_rays(device, gpu_scene, cache, bvh, lights, gbuffer, incident,
                                                         settings, sample)


def _fitting_cache(stage: Stage, gpu_scene: GpuScene, bvh: Bvh, lights: Lights, settings: RenderSettings,
                   limits: list[str]) -> LightCache:
    """The light cache at the asked resolution, or at the highest below it that the device has room for."""
    n = int(settings.cache_resolution)
    while True:
        try:
            return _cache(stage, gpu_scene, _octree(stage, gpu_scene, n), bvh, lights, settings)
        except GpuError as error:
            if n <= SMALLEST_CACHE:
                raise
            limits.append(f"The light cache has {n // 2} voxels a side instead of {n}: {error}")
            n //= 2


def _cache_view(stage: Stage, device: Device, gpu_scene: GpuScene, settings: RenderSettings,
                film: GpuFilm) -> Callable[[GBuffer, GpuFilm], None]:
    """The surfels of the light cache, drawn as they are."""
    bvh, lights = _trees(stage, gpu_scene), _lights(stage, gpu_scene)
    cache = film.cache = _fitting_cache(stage, gpu_scene, bvh, lights, settings, film.limits)
    return lambda gbuffer, film: show_surfels(device, gpu_scene, cache, gbuffer, settings, film)


def _voxel_view(stage: Stage, device: Device, gpu_scene: GpuScene, view: View,
                settings: RenderSettings) -> Callable[[GBuffer, GpuFilm], None]:
    """The voxels of the thesis's way, drawn as they are."""
    voxels = _voxels(stage, gpu_scene, settings)
    if settings.view in ("voxel_albedo", "voxel_normal"):
        values = stage("attribute", make_attribute, voxels, settings.view == "voxel_normal").values
    else:
        values = _lit(stage, gpu_scene, voxels, view, settings).radiance
    return lambda gbuffer, film: show_voxels(device, voxels.grid, values, gbuffer, settings, film)


class Session:
    """Renders for callers in any thread. The device is made when it is first needed; results of stages are kept."""

    def __init__(self) -> None:
        self._open: tuple[GpuThread, Kept] | None = None
        self._lock = threading.Lock()

    def films(self, scene: Scene, view: View, settings: RenderSettings,
              should_stop: Callable[[], bool] = lambda: False, interval: float = 0.0) -> Iterator[Film]:
        """Yield a better Film after each sample, or at most every `interval` seconds; math.inf: the last one alone.

        should_stop is asked on the calling thread while the GPU works; when it says True, Cancelled is raised.
        Raises SceneError, ShaderError or GpuError with a sentence for the user.
        """
        thread, kept = self._opened()

        def read_films(device: Device) -> Iterator[Film]:
            due = 0.0 if math.isfinite(interval) else math.inf
            for film in render(scene, view, settings, device, kept):
                if film.is_last or time.monotonic() >= due:
                    yield _read(film, device, scene, settings)
                    due = time.monotonic() + interval

        yield from thread.iterate(read_films, should_stop)

    def forget(self, *stages: str) -> None:
        """Make what the named stages, or all, have kept from earlier frames anew in the next one."""
        thread, kept = self._opened()
        thread.call(lambda device: kept.forget(stages or None))

    def device_info(self) -> dict[str, str]:
        """renderer, vendor and version of the device."""
        return self._opened()[0].call(lambda device: device.info)

    def close(self) -> None:
        """Release the device; the next use makes a new one."""
        with self._lock:
            opened, self._open = self._open, None
        if opened:
            opened[0].close()

    def _opened(self) -> tuple[GpuThread, Kept]:
        with self._lock:
            if self._open is None:
                self._open = GpuThread(), Kept()
            return self._open


def _read(film: GpuFilm, device: Device, scene: Scene, settings: RenderSettings) -> Film:
    """The film on the host, with what it took."""
    assert film.denoiser is not None
    read = read_picture(device, film, film.denoiser, settings.passes)
    counts = {"triangles": scene.n_triangles, "lights": len(scene.lights), "samples": film.n_samples,
              "device bytes": device.n_bytes, **device.profiler.counts}
    if film.progress:
        counts["samples saved"] = film.progress.n_saved(settings.samples)
    if film.cache:
        counts["bounces"] = film.cache.n_bounces()
    read.stats.update(device=device.info["renderer"], times_ms=device.profiler.times_ms(), counts=counts,
                      limits=film.limits, resolution=int(settings.resolution))
    return read
