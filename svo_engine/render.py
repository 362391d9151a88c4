# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame: `render` reads from top to bottom as the picture in docs/architecture.md does from left to right."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

from .film import Film
from .gpu.device import Device
from .gpu.kept import Kept
from .gpu.thread import GpuThread
from .passes.debug import make_attribute, show_voxels
from .passes.gather import gather, make_incident
from .passes.light import LitVoxels, injection_of, light
from .passes.raster import make_targets, raster
from .passes.resolve import GpuFilm, make_film, resolve
from .passes.upload import upload
from .passes.voxelize import voxelize
from .scene.types import Scene, View
from .settings import RenderSettings


def render(scene: Scene, view: View, settings: RenderSettings, device: Device, kept: Kept) -> Iterator[GpuFilm]:
    """Yield the film after each sample; all in the device's own thread."""
    started = time.monotonic()
    device.profiler.reset()
    film = make_film(device, view.size)
    with film.scope, kept.frame(device) as stage:
        with device.profiler.host("upload"):
            gpu_scene = stage("upload", upload, scene)
        voxels = stage("voxelize", voxelize, gpu_scene, int(settings.resolution))
        lit = stage("light", light, gpu_scene, voxels, injection_of(settings, gpu_scene, view))
        targets = stage("targets", make_targets, view.size)
        if is_picture := settings.view == "combined":
            incident = stage("incident", make_incident, view.size)
        else:
            values = _voxel_values(stage, lit, settings)
        for sample in range(settings.samples):
            gbuffer = raster(device, gpu_scene, view, targets, settings, sample)
            if is_picture:
                gather(device, gpu_scene, lit, gbuffer, incident, settings, sample)
                resolve(device, gpu_scene, gbuffer, incident, film)
            else:
                show_voxels(device, voxels.grid, values, gbuffer, settings, film)
            is_late = 0 < settings.time_limit < time.monotonic() - started
            film.is_last = is_late or film.n_samples == settings.samples
            yield film
            if is_late:
                return


def _voxel_values(stage: Callable[..., Any], lit: LitVoxels, settings: RenderSettings) -> Any:
    """What a debug view shows of the voxels."""
    if settings.view == "voxel_radiance":
        return lit.radiance
    return stage("attribute", make_attribute, lit.voxels, settings.view == "voxel_normal").values


class Session:
    """Renders for callers in any thread. The device is made when it is first needed; results of stages are kept."""

    def __init__(self) -> None:
        self._open: tuple[GpuThread, Kept] | None = None
        self._lock = threading.Lock()

    def films(self, scene: Scene, view: View, settings: RenderSettings,
              should_stop: Callable[[], bool] = lambda: False, interval: float = 0.0) -> Iterator[Film]:
        """Yield a better Film after each sample, or at most every `interval` seconds; always the last one.

        should_stop is asked on the calling thread while the GPU works; when it says True, Cancelled is raised.
        Raises SceneError, ShaderError or GpuError with a sentence for the user.
        """
        thread, kept = self._opened()

        def read_films(device: Device) -> Iterator[Film]:
            due = 0.0
            for film in render(scene, view, settings, device, kept):
                if film.is_last or time.monotonic() >= due:
                    yield _read(film, device, scene, settings)
                    due = time.monotonic() + interval

        yield from thread.iterate(read_films, should_stop)

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
    read = film.read(device)
    counts = {"triangles": scene.n_triangles, "lights": len(scene.lights), "samples": film.n_samples,
              "device bytes": device.n_bytes, **device.profiler.counts}
    read.stats.update(device=device.info["renderer"], times_ms=device.profiler.times_ms(), counts=counts,
                      resolution=int(settings.resolution))
    return read
