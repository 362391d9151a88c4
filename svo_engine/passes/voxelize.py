# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuScene -> Voxels: every voxel that a surface touches, with the mean of what the surfaces in it look like.

Conservative, by compute [Schwarz10], in five steps: mark bits, number the voxels, add integer sums, average. The same
scene gives the same bits, because nothing depends on the order in which invocations run.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..scene import layouts
from .upload import GpuScene

GEOMETRY = ("Instances", "Positions", "Triangles", "CornerNormals", "CornerUvs", "SlotMaterials")
MATERIALS = ("Materials", "Textures", "Texels")
GRID = ("u_grid_n", "u_grid_low", "u_voxels_per_metre")
WORK = (*GRID, "u_n_instances", "u_n_work")

COUNT = Pass(("voxelize/count.comp.glsl",), (*GEOMETRY, "StripFirst"), uniforms=WORK)
MARK = Pass(("voxelize/mark.comp.glsl",), (*GEOMETRY, "StripFirst", "Occupancy"), uniforms=WORK)
ACCUMULATE = Pass(("voxelize/accumulate.comp.glsl",),
                  (*GEOMETRY, *MATERIALS, "StripFirst", "Occupancy", "VoxelFirst", "Sums"),
                  textures=("u_albedo",),
                  uniforms=(*WORK, "u_emission_unit"))
AVERAGE = Pass(("voxelize/average.comp.glsl",), ("Sums", "Voxels"), uniforms=("u_emission_unit",))
BLOCK_SUMS = Pass(("voxelize/block_sums.comp.glsl",), ("Values", "BlockSums"), uniforms=("u_n_values",))
SCAN = Pass(("voxelize/scan.comp.glsl",), ("Values", "BlockSums", "Firsts", "Total"), uniforms=("u_n_values",))

PADDING = 2  # empty voxels around the scene: a filter never reads past the border
SHIFT = 0.3819660113  # of a voxel, irrational, so that walls on round coordinates do not lie in cell borders
SCAN_BLOCK = 2048
FEW_BLOCKS = 24  # whose sums cost less than the dispatch that finds them for all


@dataclass(frozen=True)
class Grid:
    """A cube of n^3 cubic voxels. low: its lowest corner, metres relative to the scene's centre."""

    n: int
    low: tuple[float, float, float]
    voxel_size: float

    def uniforms(self) -> dict[str, Any]:
        """The uniforms of bind/grid.glsl."""
        return {"u_grid_n": self.n, "u_grid_low": self.low, "u_voxels_per_metre": 1 / self.voxel_size}


@dataclass(frozen=True, eq=False)
class Voxels:
    """Occupied voxels. occupancy: a bit each, see bind/voxels.glsl; voxels: n_voxels of the layout VOXEL."""

    scope: GpuScope
    grid: Grid
    occupancy: Any
    voxels: Any
    n_voxels: int


def make_grid(extent: float, n: int) -> Grid:
    """The grid of n voxels a side around a scene whose longest side is `extent` metres."""
    voxel_size = extent / (n - 2 * PADDING - 1) if extent > 0 else 1.0
    low = -(n / 2 - 0.5 + SHIFT) * voxel_size
    return Grid(n, (low, low, low), voxel_size)


def voxelize(device: Device, gpu_scene: GpuScene, n: int) -> Voxels:
    """Voxelize at n voxels a side, n a multiple of 4. GpuError if the voxels do not fit the device."""
    grid, scope = make_grid(gpu_scene.extent, n), device.scope()
    if not gpu_scene.n_work:
        occupancy = scope.buffer("occupancy", n**3 // 8, clear=True)
        return Voxels(scope, grid, occupancy, scope.buffer("voxels", 0), 0)
    with device.scope() as scratch:
        work, n_strips = cut_strips(device, scratch, gpu_scene, grid)
        occupancy = mark(device, scope, work, n_strips, grid)
        bits: dict[str, Any] = {"Occupancy": occupancy}
        bits["VoxelFirst"], n_voxels = number_bits(device, scratch, occupancy, n**3 // 32)

        has_emission = gpu_scene.emission_unit > 0
        constants = {"HAS_EMISSION": has_emission, "SUMS": 12 if has_emission else 9}
        sums = scratch.buffer("voxel sums", 4 * constants["SUMS"] * n_voxels, clear=True)
        unit = {"Sums": sums, "u_emission_unit": gpu_scene.emission_unit}
        device.dispatch(ACCUMULATE, n_strips, {**constants, **gpu_scene.surface_constants()},
                        **work, **gpu_scene.materials, **bits, **unit, u_albedo=gpu_scene.albedo)
        voxels = scope.buffer("voxels", layouts.dtype(layouts.VOXEL).itemsize * n_voxels)
        device.dispatch(AVERAGE, n_voxels, constants, Voxels=voxels, **unit)
    return Voxels(scope, grid, occupancy, voxels, n_voxels)


def cut_strips(device: Device, scratch: GpuScope, gpu_scene: GpuScene, grid: Grid) -> tuple[dict[str, Any], int]:
    """The resources of bind/voxel_work.glsl and the number of strips: voxelization's work, cut evenly."""
    n, counts = gpu_scene.n_work, scratch.buffer("strip counts", 4 * gpu_scene.n_work)
    work = {**gpu_scene.geometry, **grid.uniforms(), "u_n_instances": gpu_scene.n_instances, "u_n_work": n}
    device.dispatch(COUNT, n, **work, StripFirst=counts)
    work["StripFirst"] = scratch.buffer("strips", 4 * n)
    return work, scan(device, scratch, counts, n, work["StripFirst"])


def mark(device: Device, scope: GpuScope, work: dict[str, Any], n_strips: int, grid: Grid) -> Any:
    """A buffer in `scope` with a bit for each voxel of `grid`, set where a surface touches it."""
    occupancy = scope.buffer("occupancy", grid.n**3 // 8, clear=True)
    device.dispatch(MARK, n_strips, Occupancy=occupancy, **work)
    return occupancy


def number_bits(device: Device, scope: GpuScope, bits: Any, n_words: int) -> tuple[Any, int]:
    """For each of n_words words of `bits` the number of set bits before it, and the number of all."""
    first = scope.buffer("bit numbers", 4 * n_words)
    return first, scan(device, scope, bits, n_words, first, are_bits=True)


def scan(device: Device, scratch: GpuScope, values: Any, n: int, firsts: Any = None, are_bits: bool = False) -> int:
    """Put the sum of all before each of n values (u4) into `firsts`, or in their place; return the sum of all.

    are_bits: a value is the number of bits that are set in its word
    """
    n_blocks, bits = -(-n // SCAN_BLOCK), {"ARE_BITS": are_bits}
    sums, total = scratch.buffer("block sums", 4 * n_blocks), scratch.buffer("total", 4, clear=True)
    resources = {"Values": values, "BlockSums": sums, "u_n_values": n}
    has_sums = n_blocks > FEW_BLOCKS or (firsts is None and n_blocks > 1)
    if has_sums:
        device.dispatch(BLOCK_SUMS, (n_blocks - 1) * 256, bits, **resources)
    device.dispatch(SCAN, n_blocks * 256, {**bits, "HAS_SUMS": has_sums}, **resources, Total=total,
                    Firsts=values if firsts is None else firsts)
    return int(np.frombuffer(total.read(4), "u4")[0])
