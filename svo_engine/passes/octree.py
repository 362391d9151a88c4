# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuScene -> Octree: the sparse voxel octree and its surfels, which hold the light. See shaders/bind/octree.glsl.

A surfel is all surface in one voxel whose normal is widest along one axis. It has two sides, so that a wall without
thickness keeps the light of one room apart from the other's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..scene import layouts
from .upload import GpuScene
from .voxelize import GEOMETRY, GRID, MATERIALS, WORK, Grid, cut_strips, make_grid, number_bits

TREE = ("u_n_top_words", "u_n_node_words")
MARK_NODES = Pass(("octree/mark_nodes.comp.glsl",), (*GEOMETRY, "StripFirst", "Octree"), uniforms=WORK)
MARK = Pass(("octree/mark.comp.glsl",), (*GEOMETRY, "StripFirst", "Octree"), uniforms=(*WORK, *TREE))
ACCUMULATE = Pass(("octree/accumulate.comp.glsl",), (*GEOMETRY, *MATERIALS, "StripFirst", "Octree", "Sums"),
                  textures=("u_albedo",),
                  uniforms=(*WORK, *TREE, "u_emission_unit"))
AVERAGE = Pass(("octree/average.comp.glsl",), ("Sums", "Surfels"), uniforms=(*GRID, "u_emission_unit"))

NODE = 4  # children along each side of a node
NODE_WORDS = 6  # two for each axis


@dataclass(frozen=True, eq=False)
class Octree:
    """words: the buffer of bind/octree.glsl; surfels: n_surfels of the layout SURFEL."""

    scope: GpuScope
    grid: Grid
    words: Any
    surfels: Any
    n_nodes: int
    n_surfels: int

    @property
    def n_bytes(self) -> int:
        """Bytes on the device: masks, counts, surfels."""
        return self.scope.n_bytes

    @property
    def n_dense_bytes(self) -> int:
        """Bytes that a dense grid would take to hold the same: in every voxel a surfel for each of the three axes."""
        return 3 * self.grid.n**3 * layouts.dtype(layouts.SURFEL).itemsize

    def resources(self) -> dict[str, Any]:
        """What a pass that includes bind/octree.glsl needs."""
        return {"Octree": self.words, **tree_sizes(self.grid.n, self.n_nodes), **self.grid.uniforms()}


def tree_sizes(n: int, n_nodes: int) -> dict[str, int]:
    """The uniforms TREE of an octree of n^3 voxels."""
    return {"u_n_top_words": (n // NODE)**3 // 32, "u_n_node_words": NODE_WORDS * n_nodes}


def build_octree(device: Device, gpu_scene: GpuScene, n: int) -> Octree:
    """The octree of n^3 voxels, n a multiple of 16. GpuError if it does not fit the device."""
    grid, scope = make_grid(gpu_scene.extent, n), device.scope()
    n_top = (n // NODE)**3 // 32
    if not gpu_scene.n_work:
        return Octree(scope, grid, scope.buffer("octree", 8 * n_top, clear=True), scope.buffer("surfels", 0), 0, 0)
    with device.scope() as scratch:
        work, n_strips = cut_strips(device, scratch, gpu_scene, grid)
        words, n_nodes = _top(device, scope, scratch, work, n_strips, n_top)
        tree = {"Octree": words, **tree_sizes(n, n_nodes)}
        device.dispatch(MARK, n_strips, **work, **tree)
        n_node = NODE_WORDS * n_nodes
        masks = scratch.buffer("node masks", 4 * n_node)
        device.ctx.copy_buffer(masks, words, 4 * n_node, read_offset=8 * n_top)
        first, n_surfels = number_bits(device, scratch, masks, n_node)
        device.ctx.copy_buffer(words, first, 4 * n_node, write_offset=8 * n_top + 4 * n_node)
        surfels = _surfels(device, scope, scratch, gpu_scene, {**work, **tree}, n_strips, n_surfels, grid)
    return Octree(scope, grid, words, surfels, n_nodes, n_surfels)


def _top(device: Device, scope: GpuScope, scratch: GpuScope, work: dict[str, Any], n_strips: int,
         n_top: int) -> tuple[Any, int]:
    """The octree's words with the top half filled and zeros in the rest, and the number of nodes."""
    masks = scratch.buffer("top masks", 4 * n_top, clear=True)
    device.dispatch(MARK_NODES, n_strips, Octree=masks, **work)
    first, n_nodes = number_bits(device, scratch, masks, n_top)
    words = scope.buffer("octree", 4 * (2 * n_top + 2 * NODE_WORDS * n_nodes), clear=True)
    device.ctx.copy_buffer(words, masks, 4 * n_top)
    device.ctx.copy_buffer(words, first, 4 * n_top, write_offset=4 * n_top)
    return words, n_nodes


def _surfels(device: Device, scope: GpuScope, scratch: GpuScope, gpu_scene: GpuScene, work: dict[str, Any],
             n_strips: int, n_surfels: int, grid: Grid) -> Any:
    """The buffer of surfels."""
    has_emission = gpu_scene.emission_unit > 0
    constants = {"HAS_EMISSION": has_emission, "SUMS": 16 if has_emission else 13}
    sums = scratch.buffer("surfel sums", 4 * constants["SUMS"] * n_surfels, clear=True)
    unit = {"Sums": sums, "u_emission_unit": gpu_scene.emission_unit}
    device.dispatch(ACCUMULATE, n_strips, {**constants, **gpu_scene.surface_constants()},
                    **work, **gpu_scene.materials, **unit, u_albedo=gpu_scene.albedo)
    surfels = scope.buffer("surfels", layouts.dtype(layouts.SURFEL).itemsize * n_surfels)
    device.dispatch(AVERAGE, n_surfels, constants, Surfels=surfels, **grid.uniforms(), **unit)
    return surfels
