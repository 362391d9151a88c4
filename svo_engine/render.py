# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame: `render` reads from top to bottom as the picture in docs/architecture.md does from left to right."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from .errors import Cancelled, GpuError
from .film import Film
from .gpu.device import Device
from .gpu.kept import Kept
from .gpu.thread import GpuThread
from .needs import Needs, needs_of
from .nodes.sources import settled, told
from .passes.adaptive import Progress, is_done, make_progress
from .passes.bvh import build_bvh, build_meshes
from .passes.cache import LightCache, draw_light, find_light, keeps_hits, light_cache, link
from .passes.debug import make_attribute, show_surfels, show_voxels
from .passes.denoise import read_picture
from .passes.denoise.choice import Denoiser, make_denoiser, wanted
from .passes.evaluate import evaluate, restyle, see_through
from .passes.gather import gather_cones, gather_rays
from .passes.light import LitVoxels, injection_of, light
from .passes.lights import Lights, make_lights
from .passes.lights.glow import make_glow, make_sky_table
from .passes.lines import draw_lines
from .passes.octree import build_octree, color_surfels
from .passes.parts import Part, Parts, make_parts
from .passes.planes import planes_for
from .passes.programs import all_programs, programs_for
from .passes.raster import Eye, Targets, look, make_targets, raster
from .passes.resolve import GpuFilm, make_film, resolve
from .passes.tracer import Tracer, make_rest, tracer_of
from .passes.upload import GpuScene, assemble, trees_of
from .passes.upload.trees import with_stand_ins
from .passes.voxelize import Voxels, voxelize
from .scene.types import Scene, View
from .settings import RenderSettings

SMALLEST_CACHE = 32  # voxels a side
SIZES = 3  # of pictures, for which what depends on the size is kept: a viewport has a draft and the whole

Stage = Callable[..., Any]
Show = Callable[[Eye], None]


@dataclass(eq=False)
class Frame:
    """A frame as it grows.

    denoiser  what makes a picture of the film
    limits    a sentence for each setting that the device was too small for
    progress  which tiles are done, if any can be before the last sample
    cache     the light that its rays found, if there were rays
    is_last   whether the frame ends with this sample
    """

    needs: Needs
    film: GpuFilm
    denoiser: Denoiser
    limits: list[str]
    progress: Progress | None = None
    cache: LightCache | None = None
    is_last: bool = False


def render(scene: Scene, view: View, settings: RenderSettings, device: Device, kept: Kept) -> Iterator[Frame]:
    """Yield the frame after each sample; all in the device's own thread."""
    started = time.monotonic()
    sums = device.profiler.reset()
    with kept.frame(device) as stage, device.scope() as scope:
        with device.profiler.host("upload"):
            sentences, scene = told(scene), settled(scene)
            trees = trees_of(scene, stage)
            device.programs.begin(trees.variants)
            needs = needs_of(scene, settings, trees.compiled)
            is_software = device.profiler.is_software
            programs = programs_for(needs, settings, wanted(settings), is_software)
            device.prepare_frame(programs, all_programs(is_software))
            device.prepare(trees.variants)
            gpu_scene = assemble(scope, scene, needs, trees, stage)
        denoiser = stage("denoiser", make_denoiser, view.size, wanted(settings), settings.denoising_quality,
                         not needs.alpha, n_kept=SIZES)
        film = make_film(scope, view, planes_for(needs, settings, denoiser.name), gpu_scene.centre_ws,
                         is_black=settings.view != "combined")
        frame = Frame(needs, film, denoiser, [*trees.told(), *sentences, *gpu_scene.told(), *denoiser.limits],
                      make_progress(scope, film, settings))
        targets = stage("targets", make_targets, view.size, n_kept=SIZES)
        tracer, show = _method(stage, device, gpu_scene, targets, view, settings, frame)
        for sample in range(settings.samples):
            eye = film.eye = look(device, gpu_scene, view, targets, settings, sample, film.tiles, tracer)
            show(eye)
            film.n_samples += 1
            is_late = 0 < settings.time_limit < time.monotonic() - started
            frame.is_last = is_late or film.n_samples == settings.samples or is_done(device, frame.progress)
            yield frame
            device.profiler.sums = sums  # other frames may have had a turn
            if frame.is_last:
                return


# How one sample is added to the film, by method and view, and the rays that find what pixels see, if rays do


def _method(stage: Stage, device: Device, gpu_scene: GpuScene, targets: Targets, view: View, settings: RenderSettings,
            frame: Frame) -> tuple[Tracer | None, Show]:
    film = frame.film
    if settings.view.startswith("voxel"):
        return None, _voxel_view(stage, device, gpu_scene, view, settings, film)
    if settings.method == "cones" and settings.view == "combined":
        parts = stage("parts", make_parts, view.size, 0, 0, frame.needs, n_kept=SIZES)
        lit = _lit(stage, gpu_scene, _voxels(stage, gpu_scene, settings), view, settings)
        device.profiler.counts["voxels"] = lit.voxels.n_voxels
        return None, _in_parts(
            device, gpu_scene, targets, None, settings, parts,
            lambda eye, part: gather_cones(device, gpu_scene, lit, eye, parts, part, settings),
            lambda eye, part: restyle(device, gpu_scene, eye, parts, part),
            lambda eye, part: resolve(device, gpu_scene, eye, parts, part, film))
    tracer = _tracer(stage, gpu_scene)
    lights = _lights(stage, gpu_scene)
    cache = frame.cache = _fitting_cache(stage, gpu_scene, tracer, lights, settings, frame.limits)
    if settings.view.startswith("cache"):
        parts = stage("parts", make_parts, view.size, 0, 0, frame.needs, n_kept=SIZES)
        return None, _in_parts(device, gpu_scene, targets, None, settings, parts,
                               lambda eye, part: show_surfels(device, cache, eye, parts, part, settings, film))
    device.profiler.counts.update({"nodes": cache.octree.n_nodes, "surfels": cache.octree.n_surfels, **lights.counts(),
                                   "octree bytes": cache.octree.n_bytes, "dense bytes": cache.octree.n_dense_bytes})
    parts = stage("parts", make_parts, view.size, settings.gather_rays * frame.needs.emission,
                  _n_kept_draws(frame.needs, lights), frame.needs, n_kept=SIZES)
    return tracer, _in_parts(
        device, gpu_scene, targets, tracer, settings, parts,
        lambda eye, part: gather_rays(device, gpu_scene, cache, tracer, lights, eye, parts, part, settings),
        lambda eye, part: restyle(device, gpu_scene, eye, parts, part),
        lambda eye, part: resolve(device, gpu_scene, eye, parts, part, film))


def _in_parts(device: Device, gpu_scene: GpuScene, targets: Targets, tracer: Tracer | None, settings: RenderSettings,
              parts: Parts, *ends: Callable[[Eye, Part], None]) -> Show:
    """A sample, part by part: what pixels see and what that looks like, as the architecture's picture shows it, then
    what `ends` make of it."""

    def show(eye: Eye) -> None:
        for part in parts:
            raster(device, gpu_scene, eye, targets, tracer, settings, parts, part)
            evaluate(device, gpu_scene, eye, parts, part, may_pass=tracer is not None)
            if tracer:
                see_through(device, gpu_scene, eye, tracer, parts, part)
            if tracer and settings.lines:
                draw_lines(device, eye, tracer, parts, part, settings.lines)
            for end in ends:
                end(eye, part)

    return show


def _voxel_view(stage: Stage, device: Device, gpu_scene: GpuScene, view: View, settings: RenderSettings,
                film: GpuFilm) -> Show:
    """The voxels of the thesis's way, drawn as they are."""
    voxels = _voxels(stage, gpu_scene, settings)
    if settings.view in ("voxel_albedo", "voxel_normal"):
        values = stage("attribute", make_attribute, voxels, settings.view == "voxel_normal").values
    else:
        values = _lit(stage, gpu_scene, voxels, view, settings).radiance
    return lambda eye: show_voxels(device, voxels.grid, values, eye, settings, film, film.n_invocations)


def _n_kept_draws(needs: Needs, lights: Lights) -> int:
    """Draws of light that a slot has room for: reflections weigh them once more, and glass from both of its sides."""
    if not (needs.gloss or lights.glow.n_emitters):
        return 0
    return lights.n_draws * (2 if needs.glass else 1)


# Stages by what they depend on, which is all that they see: an edit redoes no more than it must


def _tracer(stage: Stage, gpu_scene: GpuScene) -> Tracer:
    bvh = stage("bvh", build_bvh, gpu_scene.placing, stage("trees", build_meshes, gpu_scene.scene.meshes))
    return tracer_of(gpu_scene, bvh, stage("rest", make_rest, bvh.height))


def _lights(stage: Stage, gpu_scene: GpuScene) -> Lights:
    table = stage("sky table", make_sky_table, gpu_scene.sky, gpu_scene.scene.world)
    glow = stage("glow", make_glow, gpu_scene.placing, gpu_scene.emission, table)
    return stage("lights", make_lights, gpu_scene.lamps, glow)


def _cache(stage: Stage, gpu_scene: GpuScene, tracer: Tracer, lights: Lights, settings: RenderSettings,
           n: int) -> LightCache:
    sky, world = gpu_scene.sky, gpu_scene.scene.world
    placing, emission = gpu_scene.placing, gpu_scene.emission
    n_rays, n_points = settings.cache_rays, settings.injection_samples
    octree = stage("octree", build_octree, placing, n)
    colors = stage("colors", color_surfels, *gpu_scene.matter, octree)
    links = stage("links", link, placing, octree, tracer, n_rays, keeps_hits(octree, n_rays, emission.highest > 0))
    found = stage("found", find_light, placing, emission, links, lights.glow, sky, world, gpu_scene.needs.world,
                  n_points)
    drawn = stage("drawn", draw_light, placing, emission, octree, tracer, lights, sky, world, n_rays, n_points)
    return stage("cache", light_cache, colors, links, found, drawn, settings.bounces)


def _voxels(stage: Stage, gpu_scene: GpuScene, settings: RenderSettings) -> Voxels:
    return stage("voxelize", voxelize, *gpu_scene.matter, int(settings.resolution))


def _lit(stage: Stage, gpu_scene: GpuScene, voxels: Voxels, view: View, settings: RenderSettings) -> LitVoxels:
    return stage("light", light, gpu_scene.lamps, voxels, injection_of(settings, gpu_scene.lamps, view))


def _fitting_cache(stage: Stage, gpu_scene: GpuScene, tracer: Tracer, lights: Lights, settings: RenderSettings,
                   limits: list[str]) -> LightCache:
    """The light cache at the asked resolution, or at the highest below it that the device has room for."""
    n = int(settings.cache_resolution)
    while True:
        try:
            return _cache(stage, gpu_scene, tracer, lights, settings, n)
        except GpuError as error:
            if n <= SMALLEST_CACHE:
                raise
            limits.append(f"The light cache has {n // 2} voxels a side instead of {n}: {error}")
            n //= 2


@dataclass(eq=False)
class _Opened:
    """A device's thread and all that render on it."""

    thread: GpuThread = field(default_factory=GpuThread)
    family: list[Kept] = field(default_factory=list)


class Session:
    """One device for callers in any thread. It is made when it is first needed.

    Each client keeps the results of its own last frame; a session is a client too, for who needs no more than one.
    """

    def __init__(self) -> None:
        self._opened: _Opened | None = None
        self._lock = threading.Lock()
        self._own = Client(self)

    def films(self, scene: Scene, view: View, settings: RenderSettings,
              should_stop: Callable[[], bool] = lambda: False, interval: float = 0.0) -> Iterator[Film]:
        """As `Client.films`."""
        return self._own.films(scene, view, settings, should_stop, interval)

    def forget(self, *stages: str) -> None:
        """As `Client.forget`."""
        self._own.forget(*stages)

    def client(self) -> Client:
        """A new one, whose frames drop nothing that another one needs: of a viewport, of previews, of final renders."""
        return Client(self)

    def device_info(self) -> dict[str, str]:
        """renderer, vendor and version of the device."""
        return self.opened().thread.call(lambda device: device.info)

    def compile_all(self) -> None:
        """From now on compile what no frame has needed yet when nothing else is to be done, so that no edit waits."""
        def compile_next(device: Device) -> bool:
            rest = [v for v in all_programs(device.profiler.is_software) if not device.has_rehearsed(*v)]
            device.profiler.reset()  # of no frame, though one may be waiting for its caller
            for variant in rest[:1]:
                device.rehearse(*variant)
            return len(rest) > 1

        self.opened().thread.when_idle(compile_next)

    def compile_now(self) -> None:
        """Compile all that any frame could need, and return when that is done: for who measures what edits cost."""

        def compile_each(device: Device) -> None:
            programs = all_programs(device.profiler.is_software)
            device.prepare(programs)  # many at a time where the driver can
            for program in programs:
                device.rehearse(*program)

        self.opened().thread.call(compile_each)

    @property
    def status(self) -> str:
        """"Compiling shaders, 4 of 17", or "" while there is nothing to tell; for any thread, and never waits."""
        opened = self._opened
        return opened.thread.status if opened else ""

    def close(self) -> None:
        """Release the device; the next use makes a new one."""
        with self._lock:
            opened, self._opened = self._opened, None
        if opened:
            opened.thread.close()

    def opened(self, only_if_there: bool = False) -> Any:
        """The device's thread, started if need be; None if only_if_there and it is not."""
        with self._lock:
            if self._opened is None and not only_if_there:
                self._opened = _Opened()
            return self._opened


class Client:
    """Renders on a session's device for one purpose, frame after frame; results of stages are kept in between."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._kept: tuple[_Opened, Kept] | None = None

    def films(self, scene: Scene, view: View, settings: RenderSettings,
              should_stop: Callable[[], bool] = lambda: False, interval: float = 0.0,
              is_draft: bool = False) -> Iterator[Film]:
        """Yield a better Film after each sample, or at most every `interval` seconds; math.inf: the last one alone.

        should_stop is asked on the calling thread while the GPU works; when it says True, Cancelled is raised.
        A draft does not wait for node trees to be compiled: plain values stand in for those that are not.
        Raises SceneError, ShaderError or GpuError with a sentence for the user.
        """
        opened = self._session.opened()

        def read_films(device: Device) -> Iterator[Film]:
            due = 0.0 if math.isfinite(interval) else math.inf
            shown = with_stand_ins(device, scene) if is_draft else scene
            for frame in render(shown, view, settings, device, self._kept_on(opened)):
                if frame.is_last or time.monotonic() >= due:
                    yield _read(frame, device, scene, settings)
                    due = time.monotonic() + interval

        yield from opened.thread.iterate(read_films, should_stop)

    def forget(self, *stages: str) -> None:
        """Make what the named stages, or all, have kept from earlier frames anew in the next one."""
        opened = self._session.opened()
        opened.thread.call(lambda device: self._kept_on(opened).forget(stages or None))

    def close(self) -> None:
        """Drop what it has kept."""
        if (opened := self._session.opened(only_if_there=True)) and self._kept and self._kept[0] is opened:
            with suppress(Cancelled):  # the device is gone, and all with it
                opened.thread.call(lambda device: self._kept_on(opened).close())
        self._kept = None

    def _kept_on(self, opened: _Opened) -> Kept:
        """What it has kept on that device; called on its thread."""
        if self._kept is None or self._kept[0] is not opened:
            self._kept = opened, Kept(opened.family)
        return self._kept[1]


def _read(frame: Frame, device: Device, scene: Scene, settings: RenderSettings) -> Film:
    """The film on the host, with what it took."""
    read = read_picture(device, frame.film, frame.denoiser, frame.limits, settings.passes)
    counts = {"triangles": scene.n_triangles, "lights": len(scene.lights), "samples": frame.film.n_samples,
              "device bytes": device.n_bytes, **device.profiler.counts}
    if frame.progress:
        counts["samples saved"] = frame.progress.n_saved(settings.samples)
    if frame.cache:
        counts["bounces"] = frame.cache.n_bounces()
    read.stats.update(device=device.info["renderer"], times_ms=device.profiler.times_ms(), counts=counts,
                      limits=frame.limits, resolution=int(settings.resolution), skipped=frame.needs.told())
    return read
