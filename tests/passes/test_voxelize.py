# SPDX-License-Identifier: GPL-3.0-or-later
"""The grid around a scene, and voxels that do not depend on how the work is cut. What is in them: tests/oracle."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.errors import GpuError
from svo_engine.gpu import device as device_module
from svo_engine.passes.upload import upload
from svo_engine.passes.voxelize import PADDING, make_grid, voxelize
from svo_engine.scene import layouts
from tests import scenes


@pytest.mark.parametrize("n", [32, 64, 128, 256])
@pytest.mark.parametrize("extent", [1e-6, 1.0, 1e6])
def test_the_grid_leaves_empty_voxels_around_the_scene(n, extent):
    grid = make_grid(extent, n)
    for corner in (-extent / 2, extent / 2):
        in_voxels = (corner - grid.low[0]) / grid.voxel_size
        assert PADDING <= in_voxels <= n - PADDING
    assert grid.uniforms()["u_voxels_per_metre"] == pytest.approx(1 / grid.voxel_size)


def test_a_scene_without_extent_has_a_grid():
    assert make_grid(0.0, 64).voxel_size > 0


def bits_of(device, scene, n=32) -> tuple[bytes, ...]:
    """Occupancy, and every field of the voxels; between the fields memory holds whatever it held before."""
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        voxels = voxelize(device, *gpu_scene.matter, n)
        with voxels.scope:
            size = layouts.dtype(layouts.VOXEL).itemsize * voxels.n_voxels
            rows = np.frombuffer(voxels.voxels.read(size), layouts.dtype(layouts.VOXEL))
            return voxels.occupancy.read(), *(rows[name].tobytes() for name in rows.dtype.names or ())


def test_voxels_are_the_same_bits_however_the_work_is_cut(device, monkeypatch):
    """Threads add to one voxel in any order; small slices change that order."""
    scene = scenes.cornell(things=(scenes.Thing(scenes.sphere("Ball", 0.3, 20), places=(scenes.moved(0.4, 0, 0.5),)),))
    first = bits_of(device, scene)
    assert bits_of(device, scene) == first
    monkeypatch.setattr(device_module, "FIRST_SLICE", 64)
    monkeypatch.setattr(device_module, "SLICE_SECONDS", 1e-9)
    monkeypatch.setattr(device, "_per_second", {})
    device.profiler.reset()
    assert bits_of(device, scene) == first
    assert device.profiler.counts["voxelize/accumulate"] > 10


def test_the_order_of_objects_does_not_matter(device):
    things = scenes.room()
    assert bits_of(device, scenes.scene(*things))[0] == bits_of(device, scenes.scene(*things[::-1]))[0]


def test_long_thin_bounds_take_no_more_memory_than_others(device):
    """1000 to 1: the grid is a cube, and what the scene does not fill costs a bit a voxel."""
    needle = scenes.Thing(scenes.box("Needle", (-500, -0.5, 0), (500, 0.5, 1)))
    gpu_scene = upload(device, scenes.scene(needle))
    with gpu_scene.scope, voxelize(device, *gpu_scene.matter, 64).scope as scope:
        assert scope.n_bytes < 64**3 // 8 + 40 * 64 * 8


def test_voxels_that_do_not_fit_are_an_error_that_names_them(device, monkeypatch):
    monkeypatch.setattr(device, "limits", {**device.limits, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE": 30_000})
    gpu_scene = upload(device, scenes.cornell())
    with gpu_scene.scope, pytest.raises(GpuError, match=r"'voxel sums' .*MiB"):
        voxelize(device, *gpu_scene.matter, 32)


def test_objects_share_one_mesh(device):
    """A thousand instances are a thousand rows, not a thousand meshes."""
    ball = scenes.sphere("Ball", 0.1, 16)
    places = tuple(scenes.moved(*p) for p in np.random.default_rng(1).uniform(-5, 5, (1000, 3)))
    one, many = (upload(device, scenes.scene(scenes.Thing(ball, places=p))) for p in (places[:1], places))
    with one.scope, many.scope:
        assert len(many.placing.draws) == 1
        assert many.scope.n_bytes - one.scope.n_bytes <= 999 * (64 + 4)
        assert many.placing.n_work == 1000 * one.placing.n_work
