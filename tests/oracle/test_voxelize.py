# SPDX-License-Identifier: GPL-3.0-or-later
"""Voxels of the device against those of slow_voxels.py, voxel for voxel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from svo_engine.passes.upload import upload
from svo_engine.passes.voxelize import SHIFT, voxelize
from svo_engine.scene import layouts
from svo_engine.scene.meshes import make_mesh
from svo_engine.scene.types import Material
from tests import scenes
from tests.oracle import slow_voxels

N = 32
TOUCH = 1e-4  # shaders/lib/triangle_box.glsl
ROUNDING = 2e-5  # voxels: a few units in the last place of coordinates up to 32, in f4


@dataclass(frozen=True, eq=False)
class Found:
    """cells (k, 3), rows of the layout VOXEL, and the scene's triangles (m, 3, 3) f8 in voxel units."""

    cells: np.ndarray
    rows: np.ndarray
    triangles: np.ndarray

    @property
    def set_of_cells(self) -> set[tuple[int, ...]]:
        return as_set(self.cells)


def as_set(cells: np.ndarray) -> set[tuple[int, ...]]:
    return {tuple(cell) for cell in cells.tolist()}


def voxels_of(device, scene, n: int = N) -> Found:
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        voxels = voxelize(device, *gpu_scene.matter, n)
        with voxels.scope:
            size = layouts.dtype(layouts.VOXEL).itemsize * voxels.n_voxels
            rows = np.frombuffer(voxels.voxels.read(size), layouts.dtype(layouts.VOXEL))
            word = rows["voxel"]
            cells = np.stack([word & 1023, word >> 10 & 1023, word >> 20], 1).astype(int)
            inst, triangles = scene.instances, []
            for mesh, matrix in zip(inst.mesh, inst.world_from_object, strict=True):
                p = scene.meshes[mesh].positions @ matrix[:3, :3].T + matrix[:3, 3] - gpu_scene.centre_ws
                triangles.append((p[scene.meshes[mesh].triangles] - voxels.grid.low) / voxels.grid.voxel_size)
    return Found(cells, rows, np.concatenate(triangles))


def mesh_of(triangles, name="Triangles"):
    triangles = np.array(triangles, "f8")
    return make_mesh(name, triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))[0]


def check_occupancy(found: Found, n: int = N) -> float:
    """All that is touched is there, nothing that is more than TOUCH away. Returns the share left to rounding."""
    must = set().union(*(as_set(slow_voxels.touched(t, n, -ROUNDING)) for t in found.triangles))
    may = set().union(*(as_set(slow_voxels.touched(t, n, TOUCH + ROUNDING)) for t in found.triangles))
    assert len(found.cells) == len(found.set_of_cells), "a voxel is there twice"
    assert must <= found.set_of_cells, f"missing {sorted(must - found.set_of_cells)[:5]}"
    assert found.set_of_cells <= may, f"not touched {sorted(found.set_of_cells - may)[:5]}"
    return (len(may) - len(must)) / max(len(may), 1)


def frame_of_bounds() -> np.ndarray:
    """Two triangles that pin the bounds of a scene to [-1, 1]^3."""
    return np.array([[[-1, -1, -1], [-0.9, -1, -1], [-1, -0.9, -1]], [[1, 1, 1], [0.9, 1, 1], [1, 0.9, 1]]])


def test_random_triangles(device):
    triangles = np.random.default_rng(1).uniform(-1, 1, (40, 3, 3))
    assert check_occupancy(voxels_of(device, scenes.scene(scenes.Thing(mesh_of(triangles))))) < 0.01


@settings(max_examples=12)
@given(st.integers(0, 10**6), st.sampled_from([1e-3, 0.01, 0.1, 0.5]))
def test_triangles_of_every_size(device, seed, size):
    """1e-3 and 0.01 of the scene are parts of a voxel; some touch one voxel, some a corner of eight."""
    rng = np.random.default_rng(seed)
    triangles = rng.uniform(-0.9, 0.9, (30, 1, 3)) + size * rng.uniform(-1, 1, (30, 3, 3))
    mesh = mesh_of([*triangles.clip(-1, 1), *frame_of_bounds()])
    check_occupancy(voxels_of(device, scenes.scene(scenes.Thing(mesh))))


def test_triangles_of_a_thousandth_of_a_voxel(device):
    rng = np.random.default_rng(2)
    triangles = rng.uniform(-0.9, 0.9, (200, 1, 3)) + 1e-3 * (2 / 27) * rng.uniform(-1, 1, (200, 3, 3))
    found = voxels_of(device, scenes.scene(scenes.Thing(mesh_of([*triangles, *frame_of_bounds()]))))
    check_occupancy(found)
    assert len(found.cells) >= 190
    assert np.allclose(unpacked(found.rows)[0], 0.8, atol=1 / 64 + 0.51 / 255), "touches keep the colour"


@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-6])
def test_slivers_have_no_hole(device, width):
    """Down to a ten-thousandth of a voxel wide. Their planes are known badly: up to 2 % more cells are marked."""
    rng = np.random.default_rng(3)
    a, b = rng.uniform(-1, 1, (2, 40, 3))
    third = a + (b - a) * rng.uniform(size=(40, 1)) + width * rng.normal(size=(40, 3))
    triangles = np.stack([a, b, third], 1).clip(-1, 1)
    found = voxels_of(device, scenes.scene(scenes.Thing(mesh_of([*triangles, *frame_of_bounds()]))), 128)
    inside = [slow_voxels.touched(t, 128, -ROUNDING) for t in found.triangles]
    must = set().union(*(as_set(cells) for cells in inside))
    assert must <= found.set_of_cells
    assert len(found.cells) < 1.02 * len(must)


def test_a_triangle_as_large_as_the_scene_and_many_small_ones(device):
    rng = np.random.default_rng(4)
    small = rng.uniform(-1, 1, (50, 1, 3)) * 0.9 + 0.05 * rng.uniform(-1, 1, (50, 3, 3))
    mesh = mesh_of([[[-1, -1, -1], [1, 1, -1], [1, 1, 1]], *small])
    check_occupancy(voxels_of(device, scenes.scene(scenes.Thing(mesh))))


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_walls_along_the_axes(device, axis):
    """One layer of voxels, 27 by 27 and the border cells that a wall of just that size touches on both sides."""
    corner, u, v = np.roll([[-1, -1, 0], [2, 0, 0], [0, 2, 0]], axis, 1)
    wall = scenes.Thing(scenes.quad("Wall", corner, u, v))
    found = voxels_of(device, scenes.scene(wall))
    check_occupancy(found)
    assert len(np.unique(found.cells[:, (2 + axis) % 3])) == 1


@pytest.mark.parametrize("n_cells", [4, 9])
def test_triangles_whose_corners_lie_in_cell_borders(device, n_cells):
    """The grid's shift is taken back: a surface in a border belongs to both sides, and to no others."""
    rng = np.random.default_rng(5)
    corners = (rng.integers(-n_cells, n_cells, (40, 3, 3)) + 0.5 - SHIFT) * (2 / 27)
    corners[:20, :, 2] = corners[:20, :1, 2]  # flat ones, in a border as a whole
    triangles = [t for t in corners if np.linalg.norm(np.cross(t[1] - t[0], t[2] - t[0])) > 0]
    found = voxels_of(device, scenes.scene(scenes.Thing(mesh_of([*triangles, *frame_of_bounds()]))))
    to_border = np.abs((found.triangles[:-2] + 0.5) % 1 - 0.5)
    assert to_border.max() < 1e-4, "the test's own triangles are not where they should be"
    check_occupancy(found)


@pytest.mark.parametrize("scale", [(1, 1, 0), (0, 1, 1), (1, 0, 0), (0, 0, 0), (1, 1, 1e-30)])
def test_objects_scaled_flat_leave_what_has_an_area(device, scale):
    """A box of scale 0 is a sheet with sides of no area, which have no normal either."""
    thing = scenes.Thing(scenes.box("Box", (-1, -1, -1), (1, 1, 1)), places=(np.diag([*scale, 1.0]),))
    found = voxels_of(device, scenes.scene(thing, scenes.Thing(scenes.quad("Far", (-1, -1, 1), (2, 0, 0), (0, 2, 0)))))
    has_area = np.linalg.norm(np.cross(found.triangles[:, 1] - found.triangles[:, 0],
                                       found.triangles[:, 2] - found.triangles[:, 0]), axis=1) > 1e-9
    check_occupancy(Found(found.cells, found.rows, found.triangles[has_area]))
    coverage = found.rows["albedo_coverage"] >> 24
    assert coverage.min() > 0
    assert np.isfinite(found.rows["emission"]).all()


RED_HOT = Material("Hot", (0.9, 0.2, 0.1), emission=(5.0, 2.5, 0.0), specular_level=0)
GLASS = Material("Glass", (0.5, 1.0, 0.25), transmission=0.5, alpha=0.75, emission=(0.0, 0.0, 1.25), specular_level=0)


Sums = dict[tuple[int, ...], tuple[float, int, np.ndarray]]


def sums_of(triangles, materials, cells) -> Sums:
    """Area, number of triangles and area-weighted sums (albedo, normal, coverage, emission) of each cell."""
    sums: Sums = {tuple(cell): (0.0, 0, np.zeros(10)) for cell in cells.tolist()}
    for triangle, material in zip(triangles, materials, strict=True):
        n = slow_voxels.unit_normal(triangle)
        albedo = np.array(material.base_color) * (1 - material.transmission)
        values = np.array([*albedo, *n, np.abs(n).max() * material.alpha, *material.emission])
        for cell in slow_voxels.touched(triangle, N, TOUCH):
            if tuple(cell) in sums:
                area, count, sum_ = sums[tuple(cell)]
                part = slow_voxels.clipped_area(triangle, cell)
                sums[tuple(cell)] = area + part, count + 1, sum_ + part * values
    return sums


def unpacked(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Albedo (n, 3), coverage (n,), normal (n, 3); the normal of voxels without one is 0."""
    bytes_ = rows["albedo_coverage"].copy().view("u1").reshape(-1, 4) / 255
    xy = rows["normal"].copy().view("i2").reshape(-1, 2) / 32767
    n = np.concatenate([xy, 1 - np.abs(xy).sum(1, keepdims=True)], 1)
    n[:, :2] -= np.where(xy >= 0, 1, -1) * np.maximum(-n[:, 2:], 0)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    n[rows["normal"] == layouts.CONSTANTS["NO_NORMAL"]] = 0
    return bytes_[:, :3], bytes_[:, 3], n


def test_means_are_weighted_by_exact_areas(device):
    """k triangles in a voxel: every one adds an error of at most one unit of 2^-18 to each sum, and either 1e-4 to its
    area by rounding (six corners of 4e-6, lengths up to 2) or 2^-13, which every touch counts at least. Over the area A
    that is an error of the mean of at most 2 k e / A, e = 1.3e-4, besides the voxel's 8 bits.
    """
    rng = np.random.default_rng(6)
    materials = [RED_HOT, GLASS, scenes.WHITE]
    groups = [rng.uniform(-0.6, 0.6, (8, 1, 3)) + size * rng.uniform(-0.4, 0.4, (8, 3, 3)) for size in (1.0, 0.3, 0.05)]
    scene = scenes.scene(*(scenes.Thing(mesh_of(g, m.name), m) for g, m in zip(groups, materials, strict=True)))
    found = voxels_of(device, scene)
    sums = sums_of(found.triangles, [m for m in materials for _ in range(8)], found.cells)
    albedo, coverage, normal = unpacked(found.rows)
    n_checked = 0
    for i, cell in enumerate(map(tuple, found.cells.tolist())):
        area, count, sum_ = sums[cell]
        error = 2 * count * 1.3e-4 / max(area, 1e-9)
        assert coverage[i] == pytest.approx(min(sum_[6], 1), abs=0.51 / 255 + count * 1.1e-4)
        if error > 0.01:
            continue  # a touch of a corner: its mean is unknown, and so is its light, which coverage weighs
        n_checked += 1
        mean = sum_ / area
        assert np.allclose(albedo[i], mean[:3], atol=0.51 / 255 + error)
        assert np.allclose(found.rows["emission"][i], mean[7:], atol=5.0 * error)
        length = np.linalg.norm(mean[3:6])
        if length > 0.15:
            assert np.linalg.norm(normal[i] - mean[3:6] / length) < (2 * error + 1e-4) / length
    assert n_checked > 0.8 * len(found.cells)


def test_two_sides_of_a_sheet_have_no_normal(device):
    """Equal areas that face each other cancel; the albedo is their mean and the coverage full."""
    up = scenes.Thing(scenes.quad("Up", (-1, -1, 0), (2, 0, 0), (0, 2, 0)), scenes.RED)
    down = scenes.Thing(scenes.quad("Down", (-1, -1, 0), (0, 2, 0), (2, 0, 0)), scenes.GREEN)
    found = voxels_of(device, scenes.scene(up, down))
    albedo, coverage, normal = unpacked(found.rows)
    assert not normal.any()
    assert np.allclose(albedo, (0.45, 0.45, 0.1), atol=1 / 255)
    assert coverage.max() == 1


def test_emission_of_a_whole_voxel_is_the_materials(device):
    found = voxels_of(device, scenes.scene(scenes.Thing(scenes.floor(), RED_HOT)))
    assert np.allclose(found.rows["emission"], (5.0, 2.5, 0.0), rtol=1e-3)


def test_tessellation_changes_nothing(device):
    """A tilted wall as 2 and as 20,000 triangles: k = 50 in a voxel, each rounded to 2^-18 at most 1 unit off."""
    meshes = [scenes.quad("Wall", (-1, -1, -0.3), (2, 0, 0.5), (0, 2, 0.1), n) for n in (1, 100)]
    walls = [voxels_of(device, scenes.scene(scenes.Thing(mesh, RED_HOT))) for mesh in meshes]
    rows = [{tuple(cell): i for i, cell in enumerate(wall.cells.tolist())} for wall in walls]
    assert rows[0].keys() == rows[1].keys()
    order = [rows[1][cell] for cell in rows[0]]
    whole, fine = unpacked(walls[0].rows), [part[order] for part in unpacked(walls[1].rows)]
    full = whole[1] > 0.05  # where the wall only touches a voxel its area is all rounding
    assert np.allclose(whole[0][full], fine[0][full], atol=1.01 / 255)
    assert np.allclose(whole[1], fine[1], atol=1.01 / 255 + 50 / 2**18)
    assert np.allclose(whole[2][full], fine[2][full], atol=2e-3)
    emission = [wall.rows["emission"] for wall in walls]
    assert np.allclose(emission[0][full], emission[1][order][full], rtol=5e-3)


def test_instances_are_voxelized_where_they_stand(device):
    turned = np.array([[0, -1, 0, 0.5], [1, 0, 0, -0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]], "f8")
    places = (np.eye(4), scenes.moved(1.5, 0, 0), turned @ np.diag([0.5, -1, 2, 1]))
    check_occupancy(voxels_of(device, scenes.scene(scenes.Thing(scenes.sphere("Ball", 0.5, 6), places=places))))


@pytest.mark.parametrize("n", [32, 64])
def test_every_resolution(device, n):
    found = voxels_of(device, scenes.cornell(), n)
    assert check_occupancy(found, n) < 0.02
    assert found.cells.min() >= 2 and found.cells.max() < n - 2  # empty voxels around the scene


def test_a_scene_without_triangles_has_no_voxels(device):
    gpu_scene = upload(device, scenes.scene())
    with gpu_scene.scope, voxelize(device, *gpu_scene.matter, N).scope:
        pass
    assert voxelize(device, *gpu_scene.matter, N).n_voxels == 0
