# SPDX-License-Identifier: GPL-3.0-or-later
"""passes/bvh.py: valid trees of good shape, the same in every build, over whatever meshes there are."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
import pytest

from svo_engine.errors import GpuError
from svo_engine.gpu.device import Device
from svo_engine.gpu.glsl import SHADER_DIR
from svo_engine.gpu.kept import Kept
from svo_engine.passes.bvh import HIGHEST, LEAF, NONE, MeshTrees, build_bvh, build_meshes
from svo_engine.passes.upload import upload
from svo_engine.scene import layouts
from svo_engine.scene.meshes import make_mesh
from svo_engine.scene.types import Mesh
from tests import scenes
from tests.scenes import Thing, moved

NODE, TRIANGLE = layouts.dtype(layouts.BVH_NODE), layouts.dtype(layouts.BVH_TRIANGLE)


def mesh_of(corners: np.ndarray, name: str = "Mesh") -> Mesh:
    """A mesh of triangles (n, 3, 3) that share no vertices."""
    return make_mesh(name, corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))[0]


def soup(n: int, smallest: float = 0.01, largest: float = 0.1, seed: int = 0) -> np.ndarray:
    """Random triangles (n, 3, 3) in a cube of 2 m."""
    rng = np.random.default_rng(seed)
    size = np.exp(rng.uniform(np.log(smallest), np.log(largest), (n, 1, 1)))
    return rng.uniform(-1, 1, (n, 1, 3)) + size * rng.normal(size=(n, 3, 3))


@contextmanager
def trees_of(device: Device, *meshes: Mesh) -> Iterator[MeshTrees]:
    trees = build_meshes(device, meshes)
    with trees.scope:
        yield trees


@dataclass(frozen=True)
class Walked:
    """A tree walked from its root: leaves met, half the area of all boxes but the root's, nodes on the longest way."""

    leaves: np.ndarray
    area: float
    height: int


def half_area(low: np.ndarray, high: np.ndarray) -> np.ndarray:
    size = high.astype("f8") - low
    return (size * np.roll(size, 1, -1)).sum(-1)


def walk(nodes: np.ndarray, root: int, low: np.ndarray, high: np.ndarray, leaf_boxes: tuple[np.ndarray, ...]) -> Walked:
    """Check that every box is just as large as what it holds, from the root, whose box is given, to the leaves."""
    references, lows, highs = np.array([root]), low[None], high[None]
    leaves, area, height = [], 0.0, 0
    while len(references):
        is_leaf = references >= LEAF
        leaf = references[is_leaf] - LEAF
        assert (leaf_boxes[0][leaf] == lows[is_leaf]).all() and (leaf_boxes[1][leaf] == highs[is_leaf]).all()
        leaves.append(leaf)
        inner = nodes[references[~is_leaf]]
        assert (np.minimum(inner["low_a"], inner["low_b"]) == lows[~is_leaf]).all()
        assert (np.maximum(inner["high_a"], inner["high_b"]) == highs[~is_leaf]).all()
        references = np.concatenate([inner["child_a"], inner["child_b"]])
        lows, highs = (np.concatenate([inner[f"{end}_a"], inner[f"{end}_b"]]) for end in ("low", "high"))
        area += float(half_area(lows, highs).sum())
        height += bool(len(references))
        assert height <= HIGHEST
    return Walked(np.concatenate(leaves), area, height)


def walk_meshes(trees: MeshTrees, meshes: tuple[Mesh, ...]) -> list[Walked | None]:
    """Each mesh's tree, None for one without triangles; together they have each triangle in one leaf."""
    nodes = np.frombuffer(trees.nodes.read(), NODE, trees.n_nodes)
    leaves = np.frombuffer(trees.triangles.buffer.read(), TRIANGLE)
    corners = np.concatenate([mesh.positions[mesh.triangles] for mesh in meshes])
    stored = np.stack([leaves[name] for name in "abc"], 1)[: len(corners)]
    triangle = leaves["triangle"][: len(corners)]
    assert (np.sort(triangle) == np.arange(len(corners))).all()
    assert (stored == corners[triangle]).all()
    boxes = stored.min(1), stored.max(1)
    walked: list[Walked | None] = []
    first = 0
    for i, mesh in enumerate(meshes):
        if not len(mesh.triangles):
            assert trees.roots[i] == NONE
            walked.append(None)
            continue
        tree = walk(nodes, int(trees.roots[i]), trees.low[i], trees.high[i], boxes)
        assert (np.sort(triangle[tree.leaves]) == np.arange(first, first + len(mesh.triangles))).all()
        walked.append(tree)
        first += len(mesh.triangles)
    assert trees.height == max((tree.height for tree in walked if tree), default=0)
    return walked


def nested(n: int) -> np.ndarray:
    """Triangles around one centre, each larger than the last: every one is nearest to what is inside it."""
    corner = np.array([[-1, -1, 0], [1, -1, 0], [0, 2, 0]])
    return corner * np.linspace(1, 10, n)[:, None, None]


SHAPES = {
    "one triangle": soup(1), "two": soup(2), "a few": soup(37), "thousands": soup(5000),
    "all the same": np.repeat(soup(1), 3000, 0), "around one centre": nested(3000),
    "flat": soup(2000) * [1, 1, 0], "in a row": 1e-3 * soup(500) + np.arange(500)[:, None, None] * [1, 0, 0],
    "huge and tiny": soup(3000, 1e-5, 1e3), "far away": soup(1000) + np.array([1e6, 0, 0]),
    "growing": soup(200) * np.geomspace(1e-12, 1e12, 200)[:, None, None],
}


@pytest.mark.parametrize("name", SHAPES)
def test_trees_are_valid(device, name):
    """Each triangle in one leaf, each box just around its children, within the height, in few rounds."""
    mesh = mesh_of(SHAPES[name])
    before = device.profiler.counts["bvh/nearest"]
    with trees_of(device, mesh) as trees:
        walk_meshes(trees, (mesh,))
        assert trees.n_nodes == len(mesh.triangles) - 1
    assert device.profiler.counts["bvh/nearest"] - before <= 16 * np.log2(len(mesh.triangles) + 1)


def test_meshes_without_triangles(device):
    """They have no tree, wherever they stand among others."""
    empty = make_mesh("Empty", np.zeros((0, 3)), np.zeros((0, 3), "u4"))[0]
    for meshes in ((), (empty,), (empty, mesh_of(soup(9)), empty, mesh_of(soup(1)), mesh_of(soup(30)), empty)):
        with trees_of(device, *meshes) as trees:
            assert (trees.roots == NONE).tolist() == [not len(mesh.triangles) for mesh in meshes]
            if any(len(mesh.triangles) for mesh in meshes):
                walk_meshes(trees, meshes)


def test_the_same_bits_every_time(device):
    """Two builds; and a mesh gets the same shape of tree whatever other meshes are built with it."""
    mesh, others = mesh_of(soup(3000)), [mesh_of(soup(50 + i, seed=i)) for i in range(20)]
    with trees_of(device, mesh) as first, trees_of(device, mesh) as second:
        assert (np.frombuffer(first.nodes.read(), NODE) == np.frombuffer(second.nodes.read(), NODE)).all()
        assert first.triangles.buffer.read() == second.triangles.buffer.read()
        alone = walk_meshes(first, (mesh,))[0]
    with trees_of(device, *others, mesh) as trees:
        among = walk_meshes(trees, (*others, mesh))[-1]
    assert alone is not None and among is not None
    assert np.isclose(alone.area, among.area, rtol=0.02)


def test_equal_triangles_go_by_twos(device):
    """As in a grid of squares, where all neighbours are equally near: as many rounds as a balanced tree is high."""
    mesh, before = mesh_of(SHAPES["all the same"]), device.profiler.counts["bvh/nearest"]
    with trees_of(device, mesh) as trees:
        assert trees.height == 12
    assert device.profiler.counts["bvh/nearest"] - before == 12


def median_area(low: np.ndarray, high: np.ndarray) -> float:
    """Sum of the half areas of all boxes but the root's, if triangles are halved along the longest axis of centres."""
    if len(low) < 2:
        return 0.0
    centre = (low + high) / 2
    order = np.argsort(centre[:, np.ptp(centre, 0).argmax()], kind="stable")
    halves = order[: len(order) // 2], order[len(order) // 2:]
    return sum(float(half_area(low[i].min(0), high[i].max(0))) + median_area(low[i], high[i]) for i in halves)


@pytest.mark.parametrize("name", ["thousands", "huge and tiny", "flat", "ball"])
def test_trees_are_better_than_halves(device, name):
    """The cost by the surface area heuristic, number of boxes that a random ray meets, against median splits."""
    mesh = mesh_of(SHAPES[name]) if name in SHAPES else scenes.sphere("Ball", n=40)
    with trees_of(device, mesh) as trees:
        tree = walk_meshes(trees, (mesh,))[0]
    corners = mesh.positions[mesh.triangles]
    assert tree is not None
    assert tree.area < median_area(corners.min(1), corners.max(1))


def test_a_large_mesh(device):
    """100,000 triangles, those at the poles as long as a hundred others: a valid tree."""
    mesh = scenes.sphere("Large", n=160)
    with trees_of(device, mesh) as trees:
        walk_meshes(trees, (mesh,))
        assert trees.n_nodes == len(mesh.triangles) - 1 > 1e5


def test_many_small_meshes_cost_no_more_rounds(device):
    """2,000 meshes grow in the same rounds: no more of them than for one mesh of as many triangles."""
    small = tuple(mesh_of(soup(12, seed=i)) for i in range(2000))
    rounds = []
    for meshes in (small, (mesh_of(soup(24000)),)):
        before = device.profiler.counts["bvh/nearest"]
        with trees_of(device, *meshes) as trees:
            walk_meshes(trees, meshes)
        rounds.append(device.profiler.counts["bvh/nearest"] - before)
    assert rounds[0] <= rounds[1]


def stack_size() -> int:
    """References that a ray's stack in bind/trace.glsl has room for."""
    found = re.search(r"const int STACK = (\d+);", (SHADER_DIR / "bind/trace.glsl").read_text())
    assert found
    return int(found[1])


def test_the_tree_of_instances(device):
    """10,000 instances of one mesh: each in one leaf, its box around all that it shows."""
    rng = np.random.default_rng(3)
    places = []
    for _ in range(10_000):
        m = moved(*rng.uniform(-50, 50, 3))
        m[:3, :3] = np.linalg.qr(rng.normal(size=(3, 3)))[0] * rng.uniform(-2, 2)
        places.append(m)
    mesh = mesh_of(soup(30))
    scene = scenes.scene(Thing(mesh, places=tuple(places)))
    with trees_of(device, mesh) as trees:
        gpu_scene = upload(device, scene)
        with gpu_scene.scope, (bvh := build_bvh(device, gpu_scene.placing, trees)).scope:
            nodes = np.frombuffer(bvh.nodes.buffer.read(), NODE)
            assert (nodes[: trees.n_nodes] == np.frombuffer(trees.nodes.read(), NODE)).all()
            assert trees.n_nodes <= bvh.root < LEAF
            points = np.array(places)[:, None, :3, :3] @ mesh.positions[:, :, None]
            points = points[..., 0] + np.array(places)[:, None, :3, 3] - gpu_scene.centre_ws
            low, high = np.full((10_000, 3), np.nan, "f4"), np.full((10_000, 3), np.nan, "f4")
            for side in "ab":
                leaf = nodes[f"child_{side}"][trees.n_nodes:]
                is_leaf = leaf >= LEAF
                low[leaf[is_leaf] - LEAF] = nodes[f"low_{side}"][trees.n_nodes:][is_leaf]
                high[leaf[is_leaf] - LEAF] = nodes[f"high_{side}"][trees.n_nodes:][is_leaf]
            margin = 2.0**-23 * bvh.extent
            assert (low - margin <= points.min(1)).all() and (points.max(1) <= high + margin).all()
            root = nodes[bvh.root]
            tree = walk(nodes, bvh.root, np.minimum(root["low_a"], root["low_b"]),
                        np.maximum(root["high_a"], root["high_b"]), (low, high))
            assert (np.sort(tree.leaves) == np.arange(10_000)).all()
            assert bvh.height == trees.height + tree.height
            assert bvh.height <= HIGHEST <= stack_size() - 2


def test_kept_between_frames(device):
    """An unchanged scene builds nothing; a moved object only the tree of instances; a changed mesh both."""
    mesh, other = mesh_of(soup(50)), mesh_of(soup(60))
    still = scenes.scene(Thing(mesh, places=(moved(), moved(3))))
    after = scenes.scene(Thing(mesh, places=(moved(), moved(4))))
    changed = scenes.scene(Thing(other, places=(moved(), moved(4))))
    kept, built = Kept(), []
    for scene in (still, still, after, changed):
        before = Counter(device.profiler.counts)
        with kept.frame(device) as stage:
            gpu_scene = stage("upload", upload, scene)
            stage("bvh", build_bvh, gpu_scene.placing, stage("trees", build_meshes, scene.meshes))
        built.append((device.profiler.counts - before)["bvh/merge invocations"])
    kept.close()
    assert built[1] == 0
    assert built[2] == 2
    assert built[0] > 50 and built[3] > 60


def test_what_does_not_fit_is_named(device, monkeypatch):
    """A sentence with what is needed and what there is; nothing stays behind."""
    before, n_bytes = set(device.scopes), device.n_bytes
    monkeypatch.setitem(device.limits, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE", 10_000)
    with pytest.raises(GpuError, match=r"'bvh nodes of meshes' needs .* MiB, the device allows"):
        build_meshes(device, (mesh_of(soup(1000)),))
    for scope in device.scopes - before:
        scope.close()
    assert device.n_bytes == n_bytes
