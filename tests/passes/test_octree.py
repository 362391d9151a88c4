# SPDX-License-Identifier: GPL-3.0-or-later
"""The octree and its surfels against voxelization that is slow and obvious."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import pytest

from svo_engine.errors import GpuError
from svo_engine.gpu import device as device_module
from svo_engine.passes.octree import AVERAGE, BLEND, SUMS, build_octree, color_surfels
from svo_engine.passes.upload import upload
from svo_engine.passes.voxelize import make_grid
from svo_engine.scene.meshes import make_mesh
from svo_engine.scene.types import Material
from tests import scenes
from tests.compute import evaluate
from tests.on_gpu import film_of
from tests.oracle import slow_voxels
from tests.rays import RAYS, TURN
from tests.surfels import COLORS, SURFEL, Surfels, surfels_of, unpack_units
from tools import memory

N = 32
TOUCH = 1e-4  # voxels: shaders/lib/triangle_box.glsl
ROUNDING = 2e-5  # voxels: a few units in the last place of coordinates up to 32, in f4
UNIT = 1e-4  # octahedral normals: shaders/lib/math.glsl
NOTHING = 0xFFFFFFFF
EACH = SURFEL.itemsize + COLORS.itemsize  # bytes

RED_HOT = Material("Hot", (0.9, 0.2, 0.1), emission=(5.0, 2.5, 0.0), specular_level=0)
GLASS = Material("Glass", (0.5, 1.0, 0.25), transmission=0.5, emission=(0.0, 0.0, 1.25), specular_level=0)
WHITE = scenes.WHITE
GROUPS = ((RED_HOT, 1.0), (GLASS, 0.3), (WHITE, 0.05))  # materials and sizes of random triangles


def mesh_of(triangles, name="Triangles"):
    triangles = np.array(triangles, "f8")
    return make_mesh(name, triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))[0]


def random_scene(seed: int, n: int = 12, groups=GROUPS):
    """n triangles of each material in [-1, 1]^3."""
    rng = np.random.default_rng(seed)
    things = []
    for material, size in groups:
        triangles = rng.uniform(-0.7, 0.7, (n, 1, 3)) + size * rng.uniform(-0.5, 0.5, (n, 3, 3))
        things.append(scenes.Thing(mesh_of(triangles.clip(-1, 1), material.name), material))
    return scenes.scene(*things)


def in_voxels(scene, surfels: Surfels) -> tuple[np.ndarray, list[Material]]:
    """The scene's triangles (m, 3, 3) f8 that have an area, in voxel units, and their materials."""
    inst, placed, materials = scene.instances, [], []
    for i, (mesh, matrix) in enumerate(zip(inst.mesh, inst.world_from_object, strict=True)):
        corners = scene.meshes[mesh].positions[scene.meshes[mesh].triangles]
        placed.append(corners @ matrix[:3, :3].T + matrix[:3, 3])
        materials += [scene.materials[inst.slot_materials[i]]] * len(corners)
    triangles = (np.concatenate(placed) - surfels.centre_ws - surfels.grid.low) / surfels.grid.voxel_size
    edges = np.diff(triangles, axis=1)
    has_area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) > 1e-9
    return triangles[has_area], [m for m, has in zip(materials, has_area, strict=True) if has]


def folded_normal(triangle: np.ndarray) -> tuple[int, np.ndarray]:
    """The widest axis of a triangle's normal, and the normal with a positive component there."""
    n = slow_voxels.unit_normal(triangle)
    axis = int(np.abs(n).argmax())
    return axis, n * np.sign(n[axis])


def touched_keys(triangles: np.ndarray, n: int, slack: float) -> set[tuple[int, ...]]:
    """Voxel and axis of every surfel that the triangles make."""
    return {(*cell, folded_normal(triangle)[0]) for triangle in triangles
            for cell in slow_voxels.touched(triangle, n, slack).tolist()}


def nodes_of(triangles: np.ndarray, n: int, slack: float) -> int:
    """The number of cells of 4^3 voxels that triangles touch."""
    return len({cell[:3] for cell in touched_keys(triangles / 4, n // 4, slack)})


def check_keys(scene, surfels: Surfels) -> None:
    """All that is touched is there, nothing that is more than TOUCH away, and no node without need."""
    n, found = surfels.grid.n, {tuple(key) for key in surfels.keys.tolist()}
    triangles, _ = in_voxels(scene, surfels)
    must, may = (touched_keys(triangles, n, slack) for slack in (-ROUNDING, TOUCH + ROUNDING))
    assert len(found) == len(surfels.rows), "a surfel is there twice"
    assert must <= found, f"missing {sorted(must - found)[:5]}"
    assert found <= may, f"not touched {sorted(found - may)[:5]}"
    assert nodes_of(triangles, n, -ROUNDING) <= surfels.n_nodes <= nodes_of(triangles, n, TOUCH + ROUNDING)


@pytest.mark.parametrize("size", [0.03, 0.3, 2.0])
def test_surfels_are_where_triangles_touch_voxels(device, size):
    scene = random_scene(1, 30, ((WHITE, size),))
    check_keys(scene, surfels_of(device, scene, N))


@pytest.mark.parametrize("n", [32, 64])
def test_surfels_of_a_room_with_instances(device, n):
    """Turned, no normal is as wide along one axis as along another."""
    places = (scenes.moved(0.4, 0, 0.5) @ TURN, scenes.moved(-0.4, 0.3, 1.5) @ np.diag([0.5, -1, 1, 1]) @ TURN)
    scene = scenes.cornell(things=(scenes.Thing(scenes.sphere("Ball", 0.3, 6), places=places),))
    check_keys(scene, surfels_of(device, scene, n))


@pytest.mark.parametrize("n", [32, 128, 512])
def test_a_floor_is_one_layer_of_surfels_at_every_resolution(device, n):
    """A full voxel's mean position is the middle of its floor. n - 5 voxels a side, and what the border touches."""
    surfels = surfels_of(device, scenes.scene(scenes.Thing(scenes.floor())), n)
    keys, voxel = surfels.keys, surfels.grid.voxel_size
    assert (keys[:, 2:] == keys[0, 2:]).all() and keys[0, 3] == 2
    assert len(np.unique(keys, axis=0)) == len(keys) == (np.ptp(keys[:, 0]) + 1) * (np.ptp(keys[:, 1]) + 1)
    assert n - 6 <= np.ptp(keys[:, 0]) <= n - 4
    middle = surfels.centre_ws + surfels.grid.low + (keys[:, :3] + 0.5) * voxel
    full = np.abs(middle[:, :2]).max(1) < 1 - voxel
    assert np.allclose(surfels.positions[full, :2], middle[full, :2], atol=2e-3 * voxel)
    assert np.allclose(surfels.positions[:, 2], 0, atol=2e-3 * voxel)


def lookups(device, scene, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What find_surfel says of cells (k, 3) i4, (k, 3) u4 for the three axes, and the keys of all surfels."""
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        octree = build_octree(device, gpu_scene.placing, N)
        with octree.scope:
            uniforms = {**octree.resources()}
            buffers = {"Octree": uniforms.pop("Octree")}
            found = evaluate(device, "uvec3", "uvec3(find_surfel(c, 0), find_surfel(c, 1), find_surfel(c, 2))",
                             ("bind/octree.glsl",), buffers=buffers, uniforms=uniforms, c=cells)
            rows = np.frombuffer(octree.surfels.read(SURFEL.itemsize * octree.n_surfels), SURFEL)
            return found, Surfels(rows, rows, octree.grid, gpu_scene.centre_ws, octree.n_nodes, 0).keys


def test_lookups_find_each_surfel_and_nothing_else(device):
    """Every voxel and axis of the grid, and voxels outside of it."""
    side = np.arange(-2, N + 2, dtype="i4")
    cells = np.stack(np.meshgrid(side, side, side, indexing="ij"), -1).reshape(-1, 3)
    found, keys = lookups(device, random_scene(2), cells)
    got = {(*cells[i].tolist(), axis): found[i, axis] for i, axis in np.argwhere(found != NOTHING).tolist()}
    assert got == {tuple(key): i for i, key in enumerate(keys.tolist())}


Means = dict[tuple[int, ...], tuple[float, int, np.ndarray]]


def means_of(triangles: np.ndarray, materials: list[Material]) -> Means:
    """Area, number of triangles, and means (albedo, folded normal, emission) of each surfel."""
    parts = defaultdict(list)
    for triangle, material in zip(triangles, materials, strict=True):
        axis, normal = folded_normal(triangle)
        values = [*np.array(material.base_color) * (1 - material.transmission), *normal, *material.emission]
        for cell in slow_voxels.touched(triangle, N, TOUCH):
            parts[*cell.tolist(), axis].append((slow_voxels.clipped_area(triangle, cell), values))
    means: Means = {}
    for key, list_ in parts.items():
        areas = np.array([area for area, _ in list_])
        means[key] = areas.sum(), len(areas), areas @ np.array([v for _, v in list_]) / max(areas.sum(), 1e-30)
    return means


def test_means_are_weighted_by_exact_areas(device):
    """k triangles in a surfel: each adds an error of at most one unit of 2^-18 to each sum, and either 1e-4 to its area
    by rounding (six corners of 4e-6, lengths up to 2) or 2^-13, which every touch counts at least. Over the area A that
    is an error of the mean of at most 2 k e / A, e = 1.3e-4.
    """
    scene = random_scene(3)
    surfels = surfels_of(device, scene, N)
    means, n_checked = means_of(*in_voxels(scene, surfels)), 0
    for row, key, normal in zip(surfels.colors, surfels.keys.tolist(), surfels.normals, strict=True):
        area, count, mean = means[tuple(key)]
        error = 2 * count * 1.3e-4 / max(area, 1e-9)
        if error > 0.01:
            continue  # a touch of a corner
        n_checked += 1
        assert np.allclose(row["albedo"], mean[:3].clip(0, 0.9999), atol=error)
        assert np.allclose(normal, mean[3:6] / np.linalg.norm(mean[3:6]), atol=2 * error + UNIT)
        assert np.allclose(row["emission"], mean[6:], atol=5 * error)
    assert n_checked > 0.7 * len(surfels.rows)


def test_touches_keep_the_colour_and_the_normal_of_their_surface(device):
    """Each counts 32 units of 2^-18 at least: half a unit of a sum is 1/64 of the mean."""
    rng = np.random.default_rng(5)
    dust = rng.uniform(-0.9, 0.9, (200, 1, 3)) + 1e-4 * rng.uniform(-1, 1, (200, 3, 3))
    scene = scenes.scene(scenes.Thing(mesh_of([*dust, [[-1, -1, -1], [1, 1, 1], [1, 1, -1]]])))
    surfels = surfels_of(device, scene, N)
    means = means_of(*in_voxels(scene, surfels))
    n_lone = 0
    for row, key, normal in zip(surfels.colors, surfels.keys.tolist(), surfels.normals, strict=True):
        area, count, mean = means[tuple(key)]
        assert np.allclose(row["albedo"], 0.8, atol=1 / 64)
        if count == 1 and 0 < area < 2**-13:
            n_lone += 1
            assert np.allclose(normal, mean[3:6] / np.linalg.norm(mean[3:6]), atol=np.sqrt(3) / 32 + UNIT)
    assert n_lone > 100


def test_a_surfel_to_which_nothing_was_added_is_black(device):
    """Passes that are compiled apart may round a mere touch differently: marked by one, not found by another."""
    grid = make_grid(2.0, N)
    with device.scope() as scope:
        surfels, looks = scope.buffer("surfels", SURFEL.itemsize), scope.buffer("colours", COLORS.itemsize)
        sums = {"Sums": scope.buffer("sums", 4 * SUMS, clear=True), "u_n_sums": SUMS, "u_emission_unit": 0.0}
        device.dispatch(AVERAGE, 1, Surfels=surfels, **grid.uniforms(), **sums)
        device.dispatch(BLEND, 1, Surfels=surfels, Colors=looks, **sums)
        row, color = np.frombuffer(surfels.read(), SURFEL), np.frombuffer(looks.read(), COLORS)
    assert np.allclose(unpack_units(row["normal"]), (0, 0, 1))
    assert not color["albedo"].any() and not color["emission"].any()
    assert np.allclose(row["position"], grid.low)


def test_positions_lie_in_their_voxels_and_on_their_triangles(device):
    """Within the error of the mean, as above; where a surfel is one triangle's alone, on its plane."""
    scene = random_scene(4)
    surfels = surfels_of(device, scene, N)
    triangles, _ = in_voxels(scene, surfels)
    p = (surfels.rows["position"].astype("f8") - surfels.grid.low) / surfels.grid.voxel_size
    inside = p - surfels.keys[:, :3]
    assert inside.min() > -ROUNDING and inside.max() < 1 + ROUNDING
    alone = defaultdict(list)
    for triangle in triangles:
        axis, normal = folded_normal(triangle)
        for cell in slow_voxels.touched(triangle, N, TOUCH):
            area = slow_voxels.clipped_area(triangle, cell)
            alone[*cell.tolist(), axis].append((area, triangle[0], normal))
    n_checked = 0
    for position, normal, key in zip(p, surfels.normals, surfels.keys.tolist(), strict=True):
        (area, corner, plane), *others = alone[tuple(key)]
        if others or area < 0.02:
            continue
        n_checked += 1
        assert abs((position - corner) @ plane) < 2.2e-4 / area
        assert np.allclose(normal, plane, atol=2.2e-4 / area + UNIT)
    assert n_checked > 0.5 * len(p)


def test_two_faces_of_a_sheet_do_not_cancel(device):
    """Their normals point in opposite directions, and are folded; the albedo is their mean."""
    up = scenes.Thing(scenes.quad("Up", (-1, -1, 0), (2, 0, 0), (0, 2, 0)), scenes.RED)
    down = scenes.Thing(scenes.quad("Down", (-1, -1, 0), (0, 2, 0), (2, 0, 0)), scenes.GREEN)
    surfels = surfels_of(device, scenes.scene(up, down), N)
    assert np.allclose(surfels.normals, (0, 0, 1), atol=UNIT)
    assert np.allclose(surfels.colors["albedo"], (0.45, 0.45, 0.1), atol=1e-3)


@pytest.mark.parametrize("tilt", [0.0, 0.4])
def test_how_far_out_the_faces_of_a_board_lie(device, tilt):
    """Half its thickness to either side where both faces share a surfel, nothing where it has but one."""
    half, voxel = 0.005, 2 / (N - 5)
    turn = np.eye(4)
    turn[:3, :3] = [[np.cos(tilt), 0, np.sin(tilt)], [0, 1, 0], [-np.sin(tilt), 0, np.cos(tilt)]]
    board = scenes.Thing(scenes.box("Board", (-1, -1, -half), (1, 1, half)), places=(turn,))
    surfels = surfels_of(device, scenes.scene(board), N)
    p = surfels.positions @ turn[:3, :3]
    off = p[:, 2]  # of the mean position from the board's middle
    whole = (np.abs(off) < 0.002) & (np.abs(p[:, :2]).max(1) < 0.9) & (surfels.keys[:, 3] == 2)
    outer = surfels.rows["outer"].copy().view("f2").reshape(-1, 2).astype("f8")[whole] * surfels.grid.voxel_size
    assert whole.sum() > 50
    assert np.allclose(outer[:, 0], half - off[whole], atol=0.01 * voxel)
    assert np.allclose(outer[:, 1], half + off[whole], atol=0.01 * voxel)
    sheet = surfels_of(device, scenes.scene(scenes.Thing(scenes.floor(), places=(turn,))), N)
    lone = sheet.rows["outer"].copy().view("f2").reshape(-1, 2)
    assert np.abs(lone[:, 1]).max() == 0 and np.abs(lone[:, 0]).max() < 0.01


def bits_of(device, scene, n=N) -> tuple[bytes, bytes, bytes]:
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        octree = build_octree(device, gpu_scene.placing, n)
        with octree.scope, (colors := color_surfels(device, *gpu_scene.matter, octree)).scope:
            return octree.words.read(), octree.surfels.read(), colors.texels.buffer.read()


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


def test_memory_grows_with_the_surface(device):
    """Four times the resolution is 16 times the surfels, not 64; at 256 a hundredth of one entry a voxel."""
    scene = scenes.scene(scenes.Thing(scenes.sphere("Ball", 1.0, 16)))
    small, large = (surfels_of(device, scene, n) for n in (64, 256))
    assert 14 < len(large.rows) / len(small.rows) < 18
    assert 14 < large.n_bytes / small.n_bytes < 18
    assert large.n_bytes < 0.03 * 256**3 * EACH


def test_the_page_of_sizes_has_a_row_for_each_resolution(device, monkeypatch):
    small, large = memory.sizes(device, scenes.cornell(), (32, 64))
    assert small.n_dense_bytes == 3 * 32**3 * EACH
    assert EACH * small.n_surfels < small.n_bytes < small.n_dense_bytes / 10
    head, row = memory.lines([small, large])
    assert head.startswith(f"| 32 | {small.n_nodes:,} | {small.n_surfels:,} |") and head.endswith("|  |")
    assert 1.9 < float(row.split("|")[-2]) < 2.4
    monkeypatch.setattr(device, "limits", {**device.limits, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE": 300_000})
    (last,) = memory.sizes(device, scenes.cornell(), (64,))
    assert "does not fit: Buffer 'surfel sums'" in next(memory.lines([last]))


def test_an_empty_scene_has_no_surfels(device):
    surfels = surfels_of(device, scenes.scene(), N)
    assert len(surfels.rows) == surfels.n_nodes == 0


def test_surfels_that_do_not_fit_are_an_error_that_names_them(device, monkeypatch):
    monkeypatch.setattr(device, "limits", {**device.limits, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE": 100_000})
    gpu_scene = upload(device, scenes.cornell())
    with gpu_scene.scope, pytest.raises(GpuError, match=r"'surfel sums' .*MiB"):
        build_octree(device, gpu_scene.placing, N)


def test_the_frame_counts_nodes_and_surfels(session):
    counts = film_of(session, scenes.cornell(), **RAYS).stats["counts"]
    assert 100 < counts["nodes"] < (N // 4) ** 3
    assert counts["nodes"] * 8 < counts["surfels"] < counts["nodes"] * 64
