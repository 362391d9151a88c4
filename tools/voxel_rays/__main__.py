# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.voxel_rays SCENE.npz ...`: gather rays through the octree's voxels against exact ones: rate, error.

Prints a markdown table. Each point gathers 16 rays over its cosine; points lie at random on all that the camera sees,
so neighbours have nothing in common, which is the worst case for all ways.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

from svo_engine.errors import GpuError
from svo_engine.gpu.device import Device
from svo_engine.gpu.passes import Pass
from svo_engine.passes.bvh import build_bvh, build_meshes
from svo_engine.passes.cache import draw_light, find_light, light_cache, link
from svo_engine.passes.lights import make_lights
from svo_engine.passes.lights.glow import make_glow, make_sky_table
from svo_engine.passes.octree import build_octree, color_surfels
from svo_engine.passes.tracer import make_rest, tracer_of
from svo_engine.passes.upload import GpuScene, upload
from svo_engine.scene import store
from svo_engine.scene.types import Scene
from tests.tracing import Traced

from .scenes import many_balls, seen_points

GATHER = Pass("../tools/voxel_rays/gather.comp.glsl")
N_RAYS, N_TIMES = 16, 3
N_COMPARED, N_ROUNDS, N_IN_ROUND = 2048, 4, 64  # points, and rays of each: llvmpipe ends loops after 65,535 turns

WAYS: dict[str, dict[str, bool | int]] = {
    "exact": {"WAY": 0}, "voxels": {"WAY": 1}, "voxels, planes": {"WAY": 1, "PLANES": True},
    "exact near, planes far": {"WAY": 2, "PLANES": True}}
HEADER = ("scene", "voxels", "rays", "traced", "and lit", f"rRMSE, {N_RAYS} rays", "all rays", "bias", "too early",
          "too late")


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser("tools.voxel_rays", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("scenes", nargs="*", type=Path, metavar="SCENE.npz")
    parser.add_argument("--resolutions", nargs="+", type=int, default=[64, 128, 256])
    parser.add_argument("--points", type=int, default=32768, help="that gather light (default: %(default)s)")
    options = parser.parse_args()
    if options.points < N_COMPARED:
        parser.error(f"--points must be at least {N_COMPARED}")
    device = Device()
    print(f"{device.info['renderer']}; {options.points} points of {N_RAYS} rays; millions of rays a second"
          f"{' of one core' if device.profiler.is_software else ''}\n")
    print(row(*HEADER), row(*["---"] * len(HEADER)), sep="\n")
    for scene in (*map(store.load, options.scenes), many_balls()):
        for n in options.resolutions:
            try:
                for cells in measure(device, scene, n, options.points):
                    print(row(*cells), flush=True)
            except GpuError as error:
                print(row(f"{scene.n_triangles:,} triangles", str(n), str(error)), flush=True)
    device.release()
    return 0


def row(*cells: str) -> str:
    return f"| {' | '.join(cells)} |"


def measure(device: Device, scene: Scene, n: int, n_points: int) -> Iterator[tuple[str, ...]]:
    """A row of the table for each way of tracing."""
    with ExitStack() as made:

        def keep(result: Any) -> Any:
            made.callback(result.scope.close)
            return result

        gpu_scene: GpuScene = keep(upload(device, scene))
        placing, emission, sky, world = gpu_scene.placing, gpu_scene.emission, gpu_scene.sky, gpu_scene.scene.world
        bvh = keep(build_bvh(device, placing, keep(build_meshes(device, scene.meshes))))
        tracer = tracer_of(gpu_scene, bvh, keep(make_rest(device, bvh.height)))
        octree = keep(build_octree(device, placing, n))
        colors = keep(color_surfels(device, *gpu_scene.matter, octree))
        glow = keep(make_glow(device, placing, emission, keep(make_sky_table(device, sky, world))))
        lights = keep(make_lights(device, gpu_scene.lamps, glow))
        links = keep(link(device, placing, octree, tracer, 16, True))
        light = keep(find_light(device, placing, emission, links, glow, sky, world, True, 4))
        drawn = keep(draw_light(device, placing, emission, octree, tracer, lights, sky, world, 16, 4))
        cache = keep(light_cache(device, colors, links, light, drawn, 12))
        scope = made.enter_context(device.scope())
        starts = scope.buffer("starts", seen_points(Traced(device, gpu_scene, tracer), n_points))
        found = scope.buffer("found", 16 * n_points)
        resources = {**tracer.resources(), "Positions": gpu_scene.geometry["Positions"], **gpu_scene.world(),
                     **cache.resources(), **colors.resources(), "Starts": starts, "Found": found}
        constants = tracer.constants()
        rates = measure_rates(device, constants, resources, n_points)
        exact, _, _ = gather(device, {**constants, "WAY": 0}, resources)
        for name, way in WAYS.items():
            few = gather_round(device, {**constants, **way}, resources, N_ROUNDS)[:, :3]
            many, early, late = gather(device, {**constants, **way, "COMPARE": True}, resources)
            shares = (rrmse(few, exact), rrmse(many, exact), float((many - exact).mean() / exact.mean()), early, late)
            speeds = (f"{rates[name, shade]:.2f}" for shade in (False, True))
            yield (f"{scene.n_triangles:,} triangles", str(n), name, *speeds, *(f"{share:.1%}" for share in shares))


def measure_rates(device: Device, constants: dict[str, Any], resources: dict[str, Any],
                  n_points: int) -> dict[tuple[str, bool], float]:
    """Millions of rays a second of each way, without and with the light of what is hit: the best of N_TIMES rounds, in
    which the ways take turns. On processors the time is theirs, so that what else they do costs nothing.
    """
    best: dict[tuple[str, bool], float] = {}
    for _ in range(N_TIMES + 1):
        for name, way in WAYS.items():
            for shade in (False, True):
                device.profiler.reset()
                start = time.process_time()
                device.dispatch(GATHER, n_points, {**constants, **way, "SHADE": shade}, **resources, u_round=0)
                on_device = device.profiler.times_ms()[GATHER.name] / 1e3
                seconds = time.process_time() - start if device.profiler.is_software else on_device
                rate = n_points * N_RAYS / seconds / 1e6
                best[name, shade] = max(best.get((name, shade), 0.0), rate)
    return best


def gather(device: Device, constants: dict[str, Any], resources: dict[str, Any]) -> tuple[np.ndarray, float, float]:
    """E (N_COMPARED, 3) f8 [W m^-2] of all rounds, and the shares of rays that end too early and too late."""
    rounds = [gather_round(device, {**constants, "N_RAYS": N_IN_ROUND}, resources, i) for i in range(N_ROUNDS)]
    rows, n = np.stack(rounds), N_COMPARED * N_ROUNDS * N_IN_ROUND
    return rows[..., :3].mean(0), float((rows[..., 3] % 1024).sum() / n), float((rows[..., 3] // 1024).sum() / n)


def gather_round(device: Device, constants: dict[str, Any], resources: dict[str, Any], i: int) -> np.ndarray:
    device.dispatch(GATHER, N_COMPARED, constants, **resources, u_round=i)
    return np.frombuffer(resources["Found"].read(16 * N_COMPARED), "f4").reshape(-1, 4).astype("f8")


def rrmse(a: np.ndarray, r: np.ndarray) -> float:
    """Root mean square of a - r over the mean of r."""
    return float(np.sqrt(((a - r) ** 2).mean()) / r.mean())


if __name__ == "__main__":
    sys.exit(main())
