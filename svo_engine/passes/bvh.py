# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes, placed -> Bvh: a tree of boxes over each mesh's triangles and one over the instances, for bind/trace.glsl.

Built bottom-up by parallel locally-ordered clustering [Meister18]: leaves in Morton order, and in rounds each cluster
merges with that near one with which it makes the smallest box, if both choose each other. The trees of all meshes grow
in the same rounds. Ties go by index, so the same scene gives the same trees.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..gpu.texels import Texels
from ..scene import layouts
from ..scene.bounds import placed_boxes
from ..scene.types import Mesh
from .upload.placing import Placing
from .variants import variant_of
from .voxelize import scan

NEAREST = Pass("bvh/nearest.comp.glsl")
SURVIVE = Pass("bvh/survive.comp.glsl")
MERGE = Pass("bvh/merge.comp.glsl")

HIGHEST = 62  # nodes on any way from the root through both levels to a leaf, which bind/trace.glsl has a stack for
HIGHEST_OF_MESH = 36  # of them, in a mesh: a million triangles grow to about 30
FEWEST = 128  # of the clusters that could merge, one in so many has to, or all go by twos in the next round
LEAF, NONE = layouts.CONSTANTS["BVH_LEAF"], layouts.CONSTANTS["BVH_NONE"]
_HEIGHT_BITS = layouts.CONSTANTS["BVH_HEIGHT_BITS"]
_NODE = layouts.dtype(layouts.BVH_NODE).itemsize


@dataclass(frozen=True, eq=False)
class MeshTrees:
    """A tree for each mesh. nodes: n_nodes of layout BVH_NODE; triangles: texels of layout BVH_TRIANGLE, the leaves.

    roots   (n_meshes,) u4, reference of each tree's root, BVH_NONE for a mesh without triangles
    low     (n_meshes, 3) f4, metres, object space: the mesh's box; high likewise
    height  nodes on the longest way from a root to a leaf
    """

    scope: GpuScope
    nodes: Buffer
    triangles: Texels
    n_nodes: int
    roots: np.ndarray
    low: np.ndarray
    high: np.ndarray
    height: int


@dataclass(frozen=True, eq=False)
class Bvh:
    """Both levels. nodes: those of all meshes, then those over the instances; height: of both levels together.

    nodes and instances are texels of the layouts BVH_NODE and BVH_INSTANCE
    """

    scope: GpuScope
    trees: MeshTrees
    nodes: Texels
    instances: Texels
    root: int
    extent: float
    height: int
    in_lockstep: bool

    def resources(self) -> Resources:
        """The textures and uniforms of bind/trace.glsl, which reads the scene's geometry and materials too."""
        return {"u_bvh_nodes": self.nodes, "u_bvh_triangles": self.trees.triangles, "u_bvh_instances": self.instances,
                "u_bvh_root": self.root, "u_bvh_extent": self.extent}

    def constants(self) -> dict[str, bool]:
        """The constants of bind/trace.glsl."""
        return variant_of(self.in_lockstep)


def build_meshes(device: Device, meshes: tuple[Mesh, ...]) -> MeshTrees:
    """The trees of all meshes. GpuError names the buffer that does not fit."""
    scope = device.scope()
    corners = [np.concatenate([mesh.positions[mesh.triangles[:, i]] for mesh in meshes] or [np.zeros((0, 3), "f4")])
               for i in range(3)]
    counts = np.array([len(mesh.triangles) for mesh in meshes], "i8")
    tree, is_used = np.repeat(np.arange(len(meshes), dtype="u4"), counts), counts > 0
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    order = _morton_order(low, high, tree)
    triangles = np.zeros(len(order), layouts.dtype(layouts.BVH_TRIANGLE))
    for name, points in zip("abc", corners, strict=True):
        triangles[name] = points[order]
    triangles["triangle"] = order
    n_nodes = len(order) - int(is_used.sum())
    nodes = scope.buffer("bvh nodes of meshes", _NODE * n_nodes)
    made = scope.texels("bvh triangles", triangles)
    grown = _grow(device, nodes, 0, _leaves(low[order], high[order], tree), int(is_used.sum()), HIGHEST_OF_MESH)
    roots, boxes = np.full(len(meshes), NONE, "u4"), np.zeros((2, len(meshes), 3), "f4")
    roots[is_used], boxes[:, is_used] = grown["reference"], (grown["low"], grown["high"])
    return MeshTrees(scope, nodes, made, n_nodes, roots, boxes[0], boxes[1], _height(grown))


def build_bvh(device: Device, placing: Placing, trees: MeshTrees) -> Bvh:
    """Both levels over what is placed, whose meshes `trees` are of. GpuError names the buffer that does not fit."""
    scope, mesh = device.scope(), placing.placed.mesh[placing.order]
    world_from_object, object_from_world = _matrices(placing)
    boxes = placed_boxes(np.stack([trees.low, trees.high], 1)[mesh], world_from_object)
    low, high = boxes.astype("f4").swapaxes(0, 1)  # rounded to nearest: rays allow for that
    rows = np.zeros(len(mesh), layouts.dtype(layouts.BVH_INSTANCE))
    rows["inv_x"], rows["inv_y"], rows["inv_z"] = np.moveaxis(object_from_world, 1, 0)
    rows["root"] = trees.roots[mesh]
    rows["extent"] = np.maximum(np.abs(trees.low), np.abs(trees.high)).max(1, initial=0)[mesh]
    shown = np.flatnonzero((rows["root"] != NONE) & world_from_object[:, :, :3].any((1, 2)))
    order = shown[_morton_order(low[shown], high[shown], np.zeros(len(shown), "u4"))]
    nodes = scope.texels("bvh nodes", _NODE * (trees.n_nodes + max(len(order) - 1, 0)))
    if trees.n_nodes:
        nodes.buffer.copy_from(trees.nodes, _NODE * trees.n_nodes)
    leaves = _leaves(low[order], high[order], np.zeros(len(order), "u4"))
    leaves["reference"] = LEAF + order
    grown = _grow(device, nodes.buffer, trees.n_nodes, leaves, min(len(order), 1), HIGHEST - trees.height)
    extent = float(np.abs([low[shown], high[shown]]).max(initial=0))
    return Bvh(scope, trees, nodes, scope.texels("bvh instances", rows),
               int(grown["reference"][0]) if len(grown) else NONE, extent, _height(grown) + trees.height,
               device.profiler.is_software)


def _matrices(placing: Placing) -> tuple[np.ndarray, np.ndarray]:
    """world_from_object and object_from_world (n, 3, 4) f8 of the instances in the device's order.

    World space is relative to the scene's centre. An instance squeezed flat has no inverse: it is given a hundred
    thousandth of its width as thickness.
    """
    placed = placing.placed.world_from_object[placing.order, :3].copy()
    placed[:, :, 3] -= placing.centre_ws
    u, scale, vt = np.linalg.svd(placed[:, :, :3])
    scale = np.maximum(scale, 1e-5 * scale[:, :1])
    placed[:, :, :3] = u * scale[:, None] @ vt
    inverse = np.moveaxis(vt, 1, 2) / np.where(scale > 0, scale, 1)[:, None] @ np.moveaxis(u, 1, 2)
    return placed, np.concatenate([inverse, -inverse @ placed[:, :, 3:]], 2)


def _morton_order(low: np.ndarray, high: np.ndarray, tree: np.ndarray) -> np.ndarray:
    """Indices that sort boxes (n, 3) by tree (ascending already) and, in it, by the Morton code of their centres."""
    if not len(tree):
        return np.zeros(0, "i8")
    firsts = np.flatnonzero(np.diff(tree, prepend=-1))
    number = np.repeat(np.arange(len(firsts)), np.diff(firsts, append=len(tree)))
    bottom = np.minimum.reduceat(low, firsts).astype("f8")
    side = (np.maximum.reduceat(high, firsts) - bottom).max(1)
    scale = (2**21 - 1) / np.where(side > 0, side, 1)
    cells = (((low + high) / 2 - bottom[number]) * scale[number, None]).clip(0, 2**21 - 1).astype("u8")
    code = np.bitwise_or.reduce([_spread(cells[:, axis]) << np.uint64(axis) for axis in range(3)])
    return np.lexsort((code, tree)) if len(firsts) > 1 else np.argsort(code, kind="stable")


def _spread(bits: np.ndarray) -> np.ndarray:
    """Numbers (n,) u8 of 21 bits with two zeros after each bit."""
    for shift, mask in ((32, 0x1F00000000FFFF), (16, 0x1F0000FF0000FF), (8, 0x100F00F00F00F00F),
                        (4, 0x10C30C30C30C30C3), (2, 0x1249249249249249)):
        bits = (bits | bits << np.uint64(shift)) & np.uint64(mask)
    return bits


def _leaves(low: np.ndarray, high: np.ndarray, tree: np.ndarray) -> np.ndarray:
    """Clusters of layout CLUSTER, one a leaf, each referring to the leaf of its own index."""
    rows = np.zeros(len(tree), layouts.dtype(layouts.CLUSTER))
    rows["low"], rows["high"], rows["tree_height"] = low, high, tree << _HEIGHT_BITS
    rows["reference"] = LEAF + np.arange(len(tree))
    return rows


def _grow(device: Device, nodes: Buffer, first_node: int, leaves: np.ndarray, n_trees: int,
          highest: int) -> np.ndarray:
    """Merge `leaves` until each tree has one cluster, its root; return these. Fills `nodes` from `first_node` on.

    highest: nodes on the longest way from a root to a leaf that there may be
    """
    n, take_next = len(leaves), False
    with device.scope() as scratch:
        clusters, merged = scratch.buffer("clusters", leaves), scratch.buffer("merged clusters", leaves.nbytes)
        pairs = {name: scratch.buffer(name.lower(), 4 * n) for name in ("Neighbours", "Places")}
        while n > n_trees:
            device.dispatch(NEAREST, n, Clusters=clusters, Neighbours=pairs["Neighbours"],
                            u_n_clusters=n, u_max_height=highest - (n - n_trees).bit_length(), u_take_next=take_next)
            device.dispatch(SURVIVE, n, **pairs)
            n_left = scan(device, scratch, pairs["Places"], n)
            device.dispatch(MERGE, n, Clusters=clusters, Merged=merged, BvhNodes=nodes, u_first_node=first_node,
                            **pairs)
            take_next = (n - n_left) * FEWEST < n - n_trees
            first_node += n - n_left
            n, clusters, merged = n_left, merged, clusters
        return np.frombuffer(clusters.read(leaves.itemsize * n) if n else b"", leaves.dtype)


def _height(grown: np.ndarray) -> int:
    """The height of the highest tree."""
    return int((grown["tree_height"] & (1 << _HEIGHT_BITS) - 1).max(initial=0))
