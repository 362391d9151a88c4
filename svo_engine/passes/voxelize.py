# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces, placed -> Voxels: every voxel that a surface touches, with the mean of what the surfaces in it look like.

Conservative, by compute [Schwarz10], in five steps: mark bits, number the voxels, add integer sums, average. The same
scene gives the same bits, because nothing depends on the order in which invocations run.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..scene import layouts
from .albedo import Albedo
from .upload.emission import Emission
from .upload.looks import Looks
from .upload.placing import Placing
from .upload.surfaces import Surfaces

COUNT = Pass("voxelize/count.comp.glsl")
MARK = Pass("voxelize/mark.comp.glsl")
ACCUMULATE = Pass("voxelize/accumulate.comp.glsl")
AVERAGE = Pass("voxelize/average.comp.glsl")
BLOCK_SUMS = Pass("voxelize/block_sums.comp.glsl")
SCAN = Pass("voxelize/scan.comp.glsl")

PADDING = 2  # empty voxels around the scene: a filter never reads past the border
SHIFT = 0.3819660113  # of a voxel, irrational, so that walls on round coordinates do not lie in cell borders
SCAN_BLOCK = 2048
SUMS = 9  # words a voxel, and three more where anything shines
FEW_BLOCKS = 24  # whose sums cost less than the dispatch that finds them for all


@dataclass(frozen=True)
class Grid:
    """A cube of n^3 cubic voxels. low: its lowest corner, metres relative to the scene's centre."""

    n: int
    low: tuple[float, float, float]
    voxel_size: float

    def uniforms(self) -> Resources:
        """The uniforms of bind/grid.glsl."""
        return {"u_grid_n": self.n, "u_grid_low": self.low, "u_voxels_per_metre": 1 / self.voxel_size}


@dataclass(frozen=True, eq=False)
class Voxels:
    """Occupied voxels. occupancy: a bit each, see bind/voxels.glsl; voxels: n_voxels of the layout VOXEL."""

    scope: GpuScope
    grid: Grid
    occupancy: Buffer
    voxels: Buffer
    n_voxels: int


def make_grid(extent: float, n: int) -> Grid:
    """The grid of n voxels a side around a scene whose longest side is `extent` metres."""
    voxel_size = extent / (n - 2 * PADDING - 1) if extent > 0 else 1.0
    low = -(n / 2 - 0.5 + SHIFT) * voxel_size
    return Grid(n, (low, low, low), voxel_size)


def voxelize(device: Device, placing: Placing, surfaces: Surfaces, looks: Looks, emission: Emission,
             table: Albedo, n: int) -> Voxels:
    """Voxelize at n voxels a side, n a multiple of 4. GpuError if the voxels do not fit the device."""
    grid, scope = make_grid(placing.extent, n), device.scope()
    if not placing.n_work:
        occupancy = scope.buffer("occupancy", n**3 // 8, clear=True)
        return Voxels(scope, grid, occupancy, scope.buffer("voxels", 0), 0)
    with device.scope() as scratch:
        strips, n_strips = cut_strips(device, scratch, scratch, placing, grid)
        work = work_of(placing, grid, strips)
        occupancy = mark(device, scope, work, n_strips, grid)
        firsts, n_voxels = number_bits(device, scratch, occupancy, n**3 // 32)
        n_sums = SUMS + 3 * (emission.highest > 0)
        sums: Resources = {"Sums": scratch.buffer("voxel sums", 4 * n_sums * n_voxels, clear=True),
                           "u_n_sums": n_sums, "u_emission_unit": emission.highest}
        device.dispatch(ACCUMULATE, n_strips, **work, **surfaces.materials, **looks.baked, **sums, Occupancy=occupancy,
                        VoxelFirst=firsts, u_albedo=table.table)
        voxels = scope.buffer("voxels", layouts.dtype(layouts.VOXEL).itemsize * n_voxels)
        device.dispatch(AVERAGE, n_voxels, Voxels=voxels, **sums)
    return Voxels(scope, grid, occupancy, voxels, n_voxels)


def cut_strips(device: Device, scope: GpuScope, scratch: GpuScope, placing: Placing, grid: Grid) -> tuple[Buffer, int]:
    """Voxelization's work, cut evenly: in `scope` the first strip of each triangle, and the number of strips."""
    n, counts = placing.n_work, scratch.buffer("strip counts", 4 * placing.n_work)
    device.dispatch(COUNT, n, **work_of(placing, grid, counts))
    firsts = scope.buffer("strips", 4 * n)
    return firsts, scan(device, scratch, counts, n, firsts)


def work_of(placing: Placing, grid: Grid, strips: Buffer) -> Resources:
    """What bind/voxel_work.glsl reads."""
    return {**placing.geometry, **grid.uniforms(), "u_n_instances": placing.n_instances, "u_n_work": placing.n_work,
            "StripFirst": strips}


def mark(device: Device, scope: GpuScope, work: Resources, n_strips: int, grid: Grid) -> Buffer:
    """A buffer in `scope` with a bit for each voxel of `grid`, set where a surface touches it."""
    occupancy = scope.buffer("occupancy", grid.n**3 // 8, clear=True)
    device.dispatch(MARK, n_strips, Occupancy=occupancy, **work)
    return occupancy


def number_bits(device: Device, scope: GpuScope, bits: Buffer, n_words: int) -> tuple[Buffer, int]:
    """For each of n_words words of `bits` the number of set bits before it, and the number of all."""
    first = scope.buffer("bit numbers", 4 * n_words)
    return first, scan(device, scope, bits, n_words, first, are_bits=True)


def scan(device: Device, scratch: GpuScope, values: Buffer, n: int, firsts: Buffer | None = None,
         are_bits: bool = False) -> int:
    """Put the sum of all before each of n values (u4) into `firsts`, or in their place; return the sum of all.

    are_bits: a value is the number of bits that are set in its word
    """
    n_blocks = -(-n // SCAN_BLOCK)
    sums, total = scratch.buffer("block sums", 4 * n_blocks), scratch.buffer("total", 4, clear=True)
    resources: Resources = {"Values": values, "BlockSums": sums, "u_n_values": n, "u_are_bits": are_bits}
    has_sums = n_blocks > FEW_BLOCKS or (firsts is None and n_blocks > 1)
    if has_sums:
        device.dispatch(BLOCK_SUMS, (n_blocks - 1) * 256, **resources)
    device.dispatch(SCAN, n_blocks * 256, **resources, Total=total, u_has_sums=has_sums,
                    Firsts=values if firsts is None else firsts)
    return int(np.frombuffer(total.read(4), "u4")[0])
