# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays through occupied voxels against trying every occupied voxel."""

from __future__ import annotations

import numpy as np
import pytest

from tests.compute import evaluate
from tests.oracle import slow_voxels

N = 32
MARGIN = 1e-3  # voxels: rays that pass a corner closer than this may go either way in f4


def occupancy(cells: np.ndarray, n: int) -> np.ndarray:
    """The bits of bind/voxels.glsl: blocks of 4x4x4 in two words."""
    block, cell = cells >> 2, cells & 3
    bit = (cell[:, 2] * 4 + cell[:, 1]) * 4 + cell[:, 0]
    blocks = n >> 2
    word = ((block[:, 2] * blocks + block[:, 1]) * blocks + block[:, 0]) * 2 + (bit >> 5)
    words = np.zeros(n**3 // 32, "u4")
    np.bitwise_or.at(words, word, np.uint32(1) << (bit & 31).astype("u4"))
    return words


def blocked(device, cells, o, d, t_max, n=N) -> np.ndarray:
    grid = {"u_grid_n": n, "u_grid_low": (0, 0, 0), "u_voxels_per_metre": 1.0}
    found = evaluate(device, "bool", "is_blocked(o, d, t)", ("bind/voxels.glsl",), uniforms=grid, o=o.astype("f4"),
                     buffers={"Occupancy": occupancy(cells, n)}, d=d.astype("f4"), t=np.full(len(o), t_max, "f4"))
    return found.astype(bool)


def random_rays(n: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    d = rng.normal(size=(n, 3))
    d[: n // 4, 0] = 0  # in a plane of the grid, then along an axis, then nearly so
    d[: n // 8, 1] = 0
    d[n // 8 : n // 4, :2] *= 1e-5
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    return rng.uniform(0.01, N - 0.01, (n, 3)).astype("f4").astype("f8"), d.astype("f4").astype("f8")


@pytest.mark.parametrize("n_cells", [0, 5, 60, 3000])
@pytest.mark.parametrize("t_max", [3.0, 1e30])
def test_random_rays(device, n_cells, t_max):
    cells = np.random.default_rng(1).integers(0, N, (n_cells, 3))
    o, d = random_rays(400, 2)
    found = blocked(device, cells, o, d, t_max)
    may = np.array([slow_voxels.is_blocked(cells, *ray, t_max + MARGIN, MARGIN) for ray in zip(o, d, strict=True)])
    must = np.array([slow_voxels.is_blocked(cells, *ray, t_max - MARGIN, -MARGIN) for ray in zip(o, d, strict=True)])
    assert (must <= found).all()
    assert (found <= may).all()
    assert (may != must).mean() < 0.1


def test_rays_that_start_in_cell_borders_and_run_along_them(device):
    """An origin of whole numbers, a direction with one component next to nothing: they end, and find the wall."""
    wall = np.stack([*np.meshgrid(np.arange(N), np.arange(N)), np.full((N, N), 30)], -1).reshape(-1, 3)
    tiny = np.array([0, 1e-7, -1e-7, 1e-4, -1e-4, -1e-20, -1e-30])
    x, y = (a.ravel() for a in np.meshgrid(tiny, tiny))
    d = np.stack([x, y, np.ones(len(x))], 1)
    for start in ([8, 16, 2], [15.999999, 12, 2], [12, 20.000001, 2.5]):
        o = np.tile(np.array(start, "f8"), (len(d), 1))
        assert blocked(device, wall, o, d, 1e30).all()
        assert not blocked(device, wall, o, d, 20.0).any()
        assert not blocked(device, wall, o, -d, 1e30).any()


def test_rays_through_empty_space_end(device):
    """Near an axis, through 128 cells, across borders that are passed by less than a position rounds to."""
    rng = np.random.default_rng(3)
    d = rng.normal(size=(100_000, 3))
    d[:, :2] = -(10.0 ** rng.uniform(-7, -1, (len(d), 2)))
    o = rng.uniform(90, 127, (len(d), 3))
    assert not blocked(device, np.zeros((0, 3), int), o, d / np.linalg.norm(d, axis=1, keepdims=True), 1e30, 128).any()


def test_rays_from_outside_and_rays_without_direction_end(device):
    cells = np.array([[1, 1, 1]])
    o = np.array([[-1, 1.5, 1.5], [40, 1.5, 1.5], [5, 5, 5], [5, 5, 5]])
    d = np.array([[1, 0, 0], [-1, 0, 0], [0, 0, 0], [np.nan, 0, 1]])
    assert not blocked(device, cells, o, d, 1e30).any()
