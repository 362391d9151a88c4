# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces, placed -> Octree: the sparse voxel octree and its surfels, which hold the light; shaders/bind/octree.glsl.

A surfel is all surface in one voxel whose normal is widest along one axis. It has two sides, so that a wall without
thickness keeps the light of one room apart from the other's. What surfels look like is apart from where they are.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..gpu.texels import Texels
from ..scene import layouts
from .albedo import Albedo
from .upload.emission import Emission
from .upload.looks import Looks
from .upload.placing import Placing
from .upload.surfaces import Surfaces
from .voxelize import Grid, cut_strips, make_grid, number_bits, work_of

MARK_NODES = Pass("octree/mark_nodes.comp.glsl")
MARK = Pass("octree/mark.comp.glsl")
ACCUMULATE = Pass("octree/accumulate.comp.glsl")
AVERAGE = Pass("octree/average.comp.glsl")
PAINT = Pass("octree/paint.comp.glsl")
BLEND = Pass("octree/blend.comp.glsl")

NODE = 4  # children along each side of a node
NODE_WORDS = 6  # two for each axis
SUMS = 10  # words a surfel
COLOR_SUMS = 4  # and three more where anything shines
_SURFEL, _COLORS = (layouts.dtype(layout).itemsize for layout in (layouts.SURFEL, layouts.SURFEL_COLORS))


@dataclass(frozen=True, eq=False)
class Octree:
    """words: the buffer of bind/octree.glsl; surfels: n_surfels of the layout SURFEL.

    strips  the first strip of each triangle, n_strips in all: how the work of another look at the triangles is cut
    """

    scope: GpuScope
    grid: Grid
    words: Buffer
    surfels: Buffer
    strips: Buffer
    n_strips: int
    n_nodes: int
    n_surfels: int

    @property
    def n_bytes(self) -> int:
        """Bytes on the device: masks, counts, surfels and their colours."""
        n_words = 2 * (self.grid.n // NODE)**3 // 32 + 2 * NODE_WORDS * self.n_nodes
        return 4 * n_words + (_SURFEL + _COLORS) * self.n_surfels

    @property
    def n_dense_bytes(self) -> int:
        """Bytes that a dense grid would take to hold the same: in every voxel a surfel for each of the three axes."""
        return 3 * self.grid.n**3 * (_SURFEL + _COLORS)

    def resources(self) -> Resources:
        """What a pass that includes bind/octree.glsl needs."""
        return {"Octree": self.words, **tree_sizes(self.grid.n, self.n_nodes), **self.grid.uniforms()}


@dataclass(frozen=True, eq=False)
class Colors:
    """What the surfels of an octree look like. texels: of layout SURFEL_COLORS."""

    scope: GpuScope
    texels: Texels

    def resources(self) -> Resources:
        """What a pass that includes bind/surfel_colors.glsl needs."""
        return {"u_surfel_colors": self.texels}


def tree_sizes(n: int, n_nodes: int) -> Resources:
    """The uniforms of bind/octree.glsl for n^3 voxels."""
    return {"u_n_top_words": (n // NODE)**3 // 32, "u_n_node_words": NODE_WORDS * n_nodes}


def build_octree(device: Device, placing: Placing, n: int) -> Octree:
    """The octree of n^3 voxels, n a multiple of 16. GpuError if it does not fit the device."""
    grid, scope = make_grid(placing.extent, n), device.scope()
    n_top = (n // NODE)**3 // 32
    if not placing.n_work:
        nothing = scope.buffer("surfels", 0)
        return Octree(scope, grid, scope.buffer("octree", 8 * n_top, clear=True), nothing, nothing, 0, 0, 0)
    with device.scope() as scratch:
        strips, n_strips = cut_strips(device, scope, scratch, placing, grid)
        work = work_of(placing, grid, strips)
        words, n_nodes = _top(device, scope, scratch, work, n_strips, n_top)
        tree = {"Octree": words, **tree_sizes(n, n_nodes)}
        device.dispatch(MARK, n_strips, **work, **tree)
        n_node = NODE_WORDS * n_nodes
        masks = scratch.buffer("node masks", 4 * n_node)
        masks.copy_from(words, 4 * n_node, read_offset=8 * n_top)
        first, n_surfels = number_bits(device, scratch, masks, n_node)
        words.copy_from(first, 4 * n_node, write_offset=8 * n_top + 4 * n_node)
        surfels = _surfels(device, scope, scratch, {**work, **tree}, n_strips, n_surfels, grid)
    return Octree(scope, grid, words, surfels, strips, n_strips, n_nodes, n_surfels)


def color_surfels(device: Device, placing: Placing, surfaces: Surfaces, looks: Looks, emission: Emission,
                  table: Albedo, octree: Octree) -> Colors:
    """The means of what surfaces look like. GpuError if they do not fit the device."""
    scope, n = device.scope(), octree.n_surfels
    texels = scope.texels("colours of surfels", _COLORS * max(n, 1))
    with device.scope() as scratch:
        n_sums = COLOR_SUMS + 3 * (emission.highest > 0)
        sums: Resources = {"Sums": scratch.buffer("colour sums", 4 * n_sums * n, clear=True), "u_n_sums": n_sums,
                           "u_emission_unit": emission.highest}
        if n:
            device.dispatch(PAINT, octree.n_strips, **work_of(placing, octree.grid, octree.strips), **sums,
                            **surfaces.materials, **looks.baked, u_albedo=table.table, Octree=octree.words,
                            **tree_sizes(octree.grid.n, octree.n_nodes))
            device.dispatch(BLEND, n, Surfels=octree.surfels, Colors=texels.buffer, **sums)
    return Colors(scope, texels)


def _top(device: Device, scope: GpuScope, scratch: GpuScope, work: Resources, n_strips: int,
         n_top: int) -> tuple[Buffer, int]:
    """The octree's words with the top half filled and zeros in the rest, and the number of nodes."""
    masks = scratch.buffer("top masks", 4 * n_top, clear=True)
    device.dispatch(MARK_NODES, n_strips, Octree=masks, u_n_top_words=n_top, u_n_node_words=0, **work)
    first, n_nodes = number_bits(device, scratch, masks, n_top)
    words = scope.buffer("octree", 4 * (2 * n_top + 2 * NODE_WORDS * n_nodes), clear=True)
    words.copy_from(masks, 4 * n_top)
    words.copy_from(first, 4 * n_top, write_offset=4 * n_top)
    return words, n_nodes


def _surfels(device: Device, scope: GpuScope, scratch: GpuScope, work: Resources, n_strips: int, n_surfels: int,
             grid: Grid) -> Buffer:
    """The buffer of surfels."""
    sums: Resources = {"Sums": scratch.buffer("surfel sums", 4 * SUMS * n_surfels, clear=True), "u_n_sums": SUMS}
    device.dispatch(ACCUMULATE, n_strips, **work, **sums, u_emission_unit=None)
    surfels = scope.buffer("surfels", _SURFEL * n_surfels)
    device.dispatch(AVERAGE, n_surfels, Surfels=surfels, **grid.uniforms(), **sums, u_emission_unit=None)
    return surfels
