# SPDX-License-Identifier: GPL-3.0-or-later
"""The thesis's tables, measured again: voxelization, direct light and the whole frame of its method, by GPU timers."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from ..errors import GpuError
from ..gpu.device import Device
from ..gpu.thread import GpuThread
from ..passes.upload import upload
from ..passes.voxelize import cut_strips, make_grid, mark, voxelize, work_of
from ..render import Session
from ..scene.types import Scene
from .core import Shooter
from .edits import KINDS
from .progress import Lines
from .rungs import RUNS, RUNS_SECONDS, median, repeat
from .shapes import hall
from .tables import Timed, pack, stages

SIZES = (64, 128, 256, 512)  # voxels a side
TRIANGLES = (5_000, 50_000, 500_000, 1_000_000, 5_000_000)
TRIANGLES_SIZES = (128, 512)
FRAME_SIZE = 800, 600
FRAME = {"method": "cones", "resolution": "128", "samples": 1, "denoise": False}

# Cones that end where they begin leave the light of the lamps, with shadow cones
DIRECT = {**FRAME, "cone_distance": 0.01, "specular_cone": False}


def voxelization_rows(thread: GpuThread, name: str, scene: Scene, sizes: Sequence[int],
                      lines: Lines) -> Iterator[Timed]:
    """Occupancy alone, and voxels with their attributes, at each number of voxels a side that fits the device."""
    for n in sizes:
        for what, work in (("occupancy", occupy), ("voxels", voxelize_whole)):
            lines.step(step := f"{name}: {what} at {n} cubed")
            try:
                yield thread.call(lambda device, n=n, what=what, work=work:  # type: ignore[misc]
                                  _timed(device, name, scene, n, what, work))
            except GpuError as error:
                lines.say(f"{step} is left out: {error}")


def frame_rows(name: str, scene: Scene, lines: Lines) -> Iterator[Timed]:
    """The thesis's frame at 800x600, all anew, and with direct light alone."""
    session = Session()
    shooter = Shooter(session, FRAME_SIZE)
    try:
        for what, values in (("direct light", DIRECT), ("whole frame", FRAME)):
            lines.step(f"{name}: {what}")
            shoot = partial(shooter.shoot, scene, values, anew=KINDS["all"])
            shoot()
            shots = repeat(shoot)
            gpu = stages(gpu_passes(shots[-1].parts))
            yield Timed(name, scene.n_triangles, session.device_info()["renderer"], what, int(str(FRAME["resolution"])),
                        0, sum(gpu.values()), median(shots) * 1e3, len(shots), pack(gpu))
    finally:
        session.close()


def triangle_scenes(most: int) -> Iterator[tuple[str, Scene]]:
    """Bumpy balls in a room, of 5 thousand to 5 million triangles, those up to `most`."""
    for n in TRIANGLES:
        if n <= most:
            yield f"ball of {n:,}", hall(n)


def occupy(device: Device, gpu_scene: Any, n: int) -> int:
    """Mark the voxels that surfaces touch; how many there are is not counted."""
    with device.scope() as scratch:
        grid = make_grid(gpu_scene.placing.extent, n)
        strips, n_strips = cut_strips(device, scratch, scratch, gpu_scene.placing, grid)
        mark(device, scratch, work_of(gpu_scene.placing, grid, strips), n_strips, grid)
    return 0


def voxelize_whole(device: Device, gpu_scene: Any, n: int) -> int:
    """Voxels with the means of their surfaces; their number."""
    placing, surfaces, looks, emission, table = gpu_scene.matter
    made = voxelize(device, placing, surfaces, looks, emission, table, n)
    made.scope.close()
    return made.n_voxels


def gpu_passes(times_ms: Mapping[str, float]) -> dict[str, float]:
    """The GPU's part of a profiler's times."""
    return {name: ms for name, ms in times_ms.items() if "/" in name}


def _timed(device: Device, name: str, scene: Scene, n: int, what: str,
           work: Callable[[Device, Any, int], int]) -> Timed:
    """The median of several runs, after one that is thrown away."""
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        work(device, gpu_scene, n)
        gpu: list[float] = []
        whole: list[float] = []
        n_voxels, parts = 0, {}
        while len(gpu) < RUNS and sum(whole) < RUNS_SECONDS * 1e3:
            device.finish()
            device.profiler.reset()
            start = time.perf_counter()
            n_voxels = work(device, gpu_scene, n)
            device.finish()
            whole.append((time.perf_counter() - start) * 1e3)
            parts = gpu_passes(device.profiler.times_ms())
            gpu.append(sum(parts.values()))
    return Timed(name, scene.n_triangles, device.info["renderer"], what, n, n_voxels, statistics.median(gpu),
                 statistics.median(whole), len(gpu), pack(parts))
