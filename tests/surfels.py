# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfels of the octree and the light on their sides, on the host."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

import numpy as np

from svo_engine.gpu.device import Device
from svo_engine.passes.bvh import build_bvh, build_meshes
from svo_engine.passes.cache import PARTS, draw_light, find_light, light_cache, link
from svo_engine.passes.lights import make_lights
from svo_engine.passes.lights.glow import make_glow, make_sky_table
from svo_engine.passes.octree import Colors, Octree, build_octree, color_surfels
from svo_engine.passes.tracer import make_rest, tracer_of
from svo_engine.passes.upload import GpuScene, upload
from svo_engine.passes.voxelize import Grid
from svo_engine.scene import layouts
from svo_engine.scene.types import Scene

SURFEL, COLORS = layouts.dtype(layouts.SURFEL), layouts.dtype(layouts.SURFEL_COLORS)


@dataclass(frozen=True, eq=False)
class Surfels:
    """rows: layout SURFEL, colors: SURFEL_COLORS. centre_ws: (3,) f8, metres, what the positions are relative to."""

    rows: np.ndarray
    colors: np.ndarray
    grid: Grid
    centre_ws: np.ndarray
    n_nodes: int
    n_bytes: int

    @property
    def keys(self) -> np.ndarray:
        """(n, 4) i8: voxel and axis of each."""
        word = self.rows["voxel"]
        return np.stack([word & 1023, word >> 10 & 1023, word >> 20 & 1023, word >> 30], 1).astype("i8")

    @property
    def positions(self) -> np.ndarray:
        """(n, 3) f8, metres, world space."""
        return self.rows["position"].astype("f8") + self.centre_ws

    @property
    def normals(self) -> np.ndarray:
        """(n, 3) f8, unit."""
        return unpack_units(self.rows["normal"])


def unpack_units(words: np.ndarray) -> np.ndarray:
    """Octahedral words (n,) u4 as unit vectors (n, 3) f8."""
    xy = words.copy().view("i2").reshape(-1, 2) / 32767
    n = np.concatenate([xy, 1 - np.abs(xy).sum(1, keepdims=True)], 1)
    n[:, :2] -= np.where(xy >= 0, 1, -1) * np.maximum(-n[:, 2:], 0)
    return n / np.linalg.norm(n, axis=1, keepdims=True)


def read_surfels(gpu_scene: GpuScene, octree: Octree, colors: Colors) -> Surfels:
    """The surfels of an octree that exists."""
    rows, looks = (np.frombuffer(buffer.read(dtype.itemsize * n) if (n := octree.n_surfels) else b"", dtype)
                   for buffer, dtype in ((octree.surfels, SURFEL), (colors.texels.buffer, COLORS)))
    return Surfels(rows, looks, octree.grid, gpu_scene.centre_ws, octree.n_nodes, octree.n_bytes)


def surfels_of(device: Device, scene: Scene, n: int) -> Surfels:
    """The surfels of `scene` in an octree of n^3 voxels."""
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        octree = build_octree(device, gpu_scene.placing, n)
        with octree.scope:
            colors = color_surfels(device, *gpu_scene.matter, octree)
            with colors.scope:
                return read_surfels(gpu_scene, octree, colors)


@dataclass(frozen=True, eq=False)
class Lit:
    """Light of each side, (n_surfels, 2, 3) f8: irradiance [W m^-2] from lamps and from all else, and radiance
    [W m^-2 sr^-1] after the last bounce, emission included.
    """

    surfels: Surfels
    lamps: np.ndarray
    indirect: np.ndarray
    radiance: np.ndarray
    n_bounces: int
    bits: bytes


def lit_surfels(device: Device, scene: Scene, n: int = 32, rays: int = 16, points: int = 4, bounces: int = 12) -> Lit:
    """The light cache of `scene`, closed after it was read."""
    with ExitStack() as made:

        def keep(result: Any) -> Any:
            made.callback(result.scope.close)
            return result

        gpu_scene: GpuScene = keep(upload(device, scene))
        octree, trees = keep(build_octree(device, gpu_scene.placing, n)), keep(build_meshes(device, scene.meshes))
        colors = keep(color_surfels(device, *gpu_scene.matter, octree))
        bvh = keep(build_bvh(device, gpu_scene.placing, trees))
        tracer = tracer_of(gpu_scene, bvh, keep(make_rest(device, bvh.height)))
        placing, emission, sky, world = gpu_scene.placing, gpu_scene.emission, gpu_scene.sky, gpu_scene.scene.world
        glow = keep(make_glow(device, placing, emission, keep(make_sky_table(device, sky, world))))
        lights = keep(make_lights(device, gpu_scene.lamps, glow))
        links = keep(link(device, placing, octree, tracer, rays, emission.highest > 0))
        found = keep(find_light(device, placing, emission, links, glow, sky, world, gpu_scene.needs.world, points))
        drawn = keep(draw_light(device, placing, emission, octree, tracer, lights, sky, world, rays, points))
        cache = keep(light_cache(device, colors, links, found, drawn, bounces))
        surfels, n_bounces = read_surfels(gpu_scene, octree, colors), cache.n_bounces()
        bits = cache.entries.read(16 * PARTS * 2 * len(surfels.rows)) if len(surfels.rows) else b""
    parts = np.frombuffer(bits, "f4").astype("f8").reshape(PARTS, len(surfels.rows), 2, 4)[..., :3]
    sent = surfels.colors["emission"][:, None].astype("f8")
    return Lit(surfels, parts[0], parts[2], parts[3 + n_bounces % 2] + sent, n_bounces, bits)
