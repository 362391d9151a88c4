# SPDX-License-Identifier: GPL-3.0-or-later
"""The octree and its surfels against voxelization that is slow and obvious."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.gpu import device as device_module
from svo_engine.passes.octree import build_octree
from svo_engine.passes.upload import upload
from svo_engine.scene.meshes import make_mesh
from tests import scenes
from tests.oracle import slow_voxels
from tests.surfels import Surfels, surfels_of

TOUCH = 1e-4  # voxels: shaders/lib/triangle_box.glsl
ROUNDING = 2e-5  # voxels: a few units in the last place of coordinates up to 32, in f4


def mesh_of(triangles):
    triangles = np.array(triangles, "f8")
    return make_mesh("Triangles", triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))[0]


def random_scene(seed: int, n: int, size: float):
    """n triangles in [-1, 1]^3, of sides about `size`."""
    rng = np.random.default_rng(seed)
    triangles = rng.uniform(-0.9, 0.9, (n, 1, 3)) + size * rng.uniform(-1, 1, (n, 3, 3))
    return scenes.scene(scenes.Thing(mesh_of(triangles.clip(-1, 1))))


def in_voxels(scene, surfels: Surfels) -> np.ndarray:
    """The scene's triangles (m, 3, 3) f8 in voxel units."""
    placed = [scene.meshes[mesh].positions[scene.meshes[mesh].triangles] @ matrix[:3, :3].T + matrix[:3, 3]
              for mesh, matrix in zip(scene.instances.mesh, scene.instances.world_from_object, strict=True)]
    return (np.concatenate(placed) - surfels.centre_ws - surfels.grid.low) / surfels.grid.voxel_size


def touched_keys(triangles: np.ndarray, n: int, slack: float) -> set[tuple[int, ...]]:
    """Voxel and widest axis of the normal, of every voxel that a triangle touches."""
    keys = set()
    for triangle in triangles:
        axis = int(np.abs(slow_voxels.unit_normal(triangle)).argmax())
        keys |= {(*cell, axis) for cell in slow_voxels.touched(triangle, n, slack).tolist()}
    return keys


def check_keys(scene, surfels: Surfels) -> None:
    """All that is touched is there, nothing that is more than TOUCH away, and the nodes are those that this needs."""
    n, found = surfels.grid.n, {tuple(key) for key in surfels.keys.tolist()}
    triangles = in_voxels(scene, surfels)
    must, may = (touched_keys(triangles, n, slack) for slack in (-ROUNDING, TOUCH + ROUNDING))
    assert len(found) == len(surfels.rows), "a surfel is there twice"
    assert must <= found, f"missing {sorted(must - found)[:5]}"
    assert found <= may, f"not touched {sorted(found - may)[:5]}"
    assert len({(x >> 2, y >> 2, z >> 2) for x, y, z, _ in found}) <= surfels.n_nodes
    assert surfels.n_nodes <= len({(x >> 2, y >> 2, z >> 2) for x, y, z, _ in may})


@pytest.mark.parametrize("size", [0.03, 0.3, 1.0])
def test_surfels_are_where_triangles_touch_voxels(device, size):
    scene = random_scene(1, 30, size)
    check_keys(scene, surfels_of(device, scene, 32))


def bits_of(device, scene, n=32) -> tuple[bytes, bytes]:
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        octree = build_octree(device, gpu_scene, n)
        with octree.scope:
            return octree.words.read(), octree.surfels.read()


def test_octrees_are_the_same_bits_however_the_work_is_cut(device, monkeypatch):
    """64 threads add to one surfel in any order; small slices change that order."""
    scene = scenes.cornell(things=(scenes.Thing(scenes.sphere("Ball", 0.3, 20), places=(scenes.moved(0.4, 0, 0.5),)),))
    first = bits_of(device, scene)
    assert bits_of(device, scene) == first
    monkeypatch.setattr(device_module, "FIRST_SLICE", 64)
    monkeypatch.setattr(device_module, "SLICE_SECONDS", 1e-9)
    monkeypatch.setattr(device, "_per_second", {})
    device.profiler.reset()
    assert bits_of(device, scene) == first
    assert device.profiler.counts["octree/accumulate"] > 10
