# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of a triangle inside a voxel against polygons that are cut in f8, side by side."""

from __future__ import annotations

import numpy as np
import pytest

from tests.compute import evaluate
from tests.oracle import slow_voxels

N = 32
PRELUDE = """
vec4 part_of(vec3 a, vec3 b, vec3 c, ivec3 cell)
{
    VoxelTriangle t = voxel_triangle(a, b, c, 32);
    vec4 part = clipped_part(t, ivec3(turned(vec3(cell), t.axis)));
    return vec4(turned_back(part.xyz, t.axis), part.w);
}
"""


def touched(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Each triangle (n, 3, 3) that has an area once for each cell (n, 3) that it meets, as f4 has its corners."""
    edges = np.diff(triangles, axis=1)
    has_area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) > 1e-9
    pairs = [(triangle, cell) for triangle in triangles[has_area].astype("f4").astype("f8")
             for cell in slow_voxels.touched(triangle, N, 0.0)]
    return np.array([triangle for triangle, _ in pairs]), np.array([cell for _, cell in pairs])


def check_parts(device, triangles: np.ndarray) -> None:
    """An error of 4e-6 in each of two coordinates along an outline of at most 6 makes 5e-5 of area, or of moment."""
    pairs, cells = touched(triangles)
    a, b, c = pairs.astype("f4").swapaxes(0, 1)
    found = evaluate(device, "vec4", "part_of(a, b, c, cell)", ("lib/triangle_box.glsl",), PRELUDE, a=a, b=b, c=c,
                     cell=cells.astype("i4")).astype("f8")
    areas = np.array([slow_voxels.clipped_area(*pair) for pair in zip(pairs, cells, strict=True)])
    moments = np.array([slow_voxels.clipped_moment(*pair) for pair in zip(pairs, cells, strict=True)])
    assert len(cells) > 15
    assert np.abs(found[:, 3] - areas).max() < 5e-5
    assert np.abs(areas[:, None] * (found[:, :3] - cells) - (moments - areas[:, None] * cells)).max() < 5e-5
    assert (found[:, :3] >= cells).all() and (found[:, :3] <= cells + 1).all()


@pytest.mark.parametrize("size", [0.01, 0.3, 1.0, 5.0, 30.0])
def test_parts_of_random_triangles(device, size):
    """From those inside one voxel to those that fill whole sections of it."""
    rng = np.random.default_rng(1)
    n = 200 if size < 1 else 8
    check_parts(device, (rng.uniform(1, N - 1, (n, 1, 3)) + size * rng.uniform(-0.5, 0.5, (n, 3, 3))).clip(0, N))


def test_edges_and_corners_in_the_sides_of_voxels(device):
    rng = np.random.default_rng(2)
    check_parts(device, rng.integers(8, 16, (60, 3, 3)) / 2.0)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_walls_fill_a_section(device, axis):
    """Level and tilted: one voxel's section has the area 1 / |n| along the widest axis."""
    wall = np.array([[0.0, 0, 0.3], [32, 0, 0.3], [0, 32, 0.3]])
    tilted = wall + [0, 0, 5] + wall[:, :1] * [0, 0, 0.1] + wall[:, 1:2] * [0, 0, 0.7]
    check_parts(device, np.roll([wall, tilted], axis, axis=2))


@pytest.mark.parametrize("width", [1e-2, 1e-4])
def test_parts_of_slivers(device, width):
    rng = np.random.default_rng(3)
    a, b = rng.uniform(1, N - 1, (2, 20, 3))
    c = a + (b - a) * rng.uniform(size=(20, 1)) + width * rng.normal(size=(20, 3))
    check_parts(device, np.stack([a, b, c], 1).clip(0, N))
