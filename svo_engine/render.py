# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame: `render` reads from top to bottom as the picture in docs/architecture.md does from left to right."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from .film import Film
from .gpu.device import Device
from .gpu.thread import GpuThread
from .passes.debug import make_attribute, show_voxels
from .passes.gather import gather, make_incident
from .passes.light import LitVoxels, injection_of, light
from .passes.raster import GBuffer, make_targets, raster
from .passes.resolve import GpuFilm, make_film, resolve
from .passes.upload import GpuScene, upload
from .passes.voxelize import voxelize
from .scene.types import Scene, View
from .settings import RenderSettings

T = TypeVar("T")


class Kept:
    """The last result of each stage, given again while its inputs are the same; an edit redoes only what it touches."""

    def __init__(self) -> None:
        self._results: dict[str, tuple[tuple[Any, ...], Any]] = {}

    def __call__(self, stage: str, make: Callable[..., T], device: Device, *inputs: Any) -> T:
        """`make(device, *inputs)`, or its last result if all inputs are the same objects or equal values."""
        if stage in self._results:
            before, result = self._results[stage]
            if len(before) == len(inputs) and all(map(_same, before, inputs)):
                return result
            del self._results[stage]
            result.scope.close()
        result = make(device, *inputs)
        self._results[stage] = inputs, result
        return result


def _same(a: Any, b: Any) -> bool:
    return a is b or (isinstance(a, (int, float, str, tuple)) and a == b)


def render(scene: Scene, view: View, settings: RenderSettings, device: Device, kept: Kept) -> Iterator[GpuFilm]:
    """Yield the film after each sample; all in the device's own thread."""
    started = time.monotonic()
    device.profiler.reset()
    with device.profiler.host("upload"):
        gpu_scene = kept("upload", upload, device, scene)
    voxels = kept("voxelize", voxelize, device, gpu_scene, int(settings.resolution))
    lit = kept("light", light, device, gpu_scene, voxels, injection_of(settings, gpu_scene, view))
    targets = kept("targets", make_targets, device, view.size)
    film = make_film(device, view.size)
    with film.scope:
        for sample in range(settings.samples):
            gbuffer = raster(device, gpu_scene, view, targets, settings, sample)
            if settings.view == "combined":
                incident = kept("incident", make_incident, device, view.size)
                gather(device, gpu_scene, lit, gbuffer, incident, settings, sample)
                resolve(device, gpu_scene, gbuffer, incident, film)
            else:
                _show(device, kept, lit, gbuffer, settings, film)
            yield film
            if settings.time_limit and time.monotonic() - started > settings.time_limit:
                return


def _show(device: Device, kept: Kept, lit: LitVoxels, gbuffer: GBuffer, settings: RenderSettings, film: GpuFilm) -> None:
    """One sample of a debug view."""
    if settings.view in ("voxel_albedo", "voxel_normal"):
        values = kept("attribute", make_attribute, device, lit.voxels, settings.view == "voxel_normal").values
    else:
        values = lit.radiance
    show_voxels(device, lit.voxels.grid, values, gbuffer, settings, film)


class Session:
    """Renders for callers in any thread. The device is made when it is first needed; results of stages are kept."""

    def __init__(self) -> None:
        self._thread: GpuThread | None = None
        self._kept = Kept()

    def films(self, scene: Scene, view: View, settings: RenderSettings,
              should_stop: Callable[[], bool] = lambda: False, interval: float = 0.0) -> Iterator[Film]:
        """Yield a better Film after each sample, or at most every `interval` seconds; always the last one.

        should_stop is asked on the calling thread while the GPU works; when it says True, Cancelled is raised.
        Raises SceneError, ShaderError or GpuError with a sentence for the user.
        """

        def read_films(device: Device) -> Iterator[Film]:
            due = 0.0
            for film in render(scene, view, settings, device, self._kept):
                is_last = film.n_samples == settings.samples
                if is_last or time.monotonic() >= due:
                    yield _read(film, device, scene, settings)
                    due = time.monotonic() + interval

        yield from self._gpu().iterate(read_films, should_stop)

    def device_info(self) -> dict[str, str]:
        """renderer, vendor and version of the device."""
        return self._gpu().call(lambda device: device.info)

    def close(self) -> None:
        """Release the device; the next use makes a new one."""
        if self._thread is not None:
            self._thread.close()
        self._thread, self._kept = None, Kept()

    def _gpu(self) -> GpuThread:
        if self._thread is None:
            self._thread = GpuThread()
        return self._thread


def _read(film: GpuFilm, device: Device, scene: Scene, settings: RenderSettings) -> Film:
    """The film on the host, with what it took."""
    read = film.read(device)
    counts = {"triangles": scene.n_triangles, "lights": len(scene.lights), "samples": film.n_samples,
              "device bytes": device.n_bytes, **device.profiler.counts}
    read.stats.update(device=device.info["renderer"], times_ms=device.profiler.times_ms(), counts=counts,
                      resolution=int(settings.resolution))
    return read
