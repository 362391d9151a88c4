# SPDX-License-Identifier: GPL-3.0-or-later
"""Trees, placed -> Looks: what trees of nodes look like to all programs that do not evaluate them.

A triangle whose material is a tree is cut into cells. The tree is evaluated in the middle of each, as diffuse light
sees it: surfels, points drawn on emitters, and rays that alpha may let through read its cell. What the eye and its
paths see is evaluated itself.
"""

from __future__ import annotations

import numpy as np

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..gpu.texels import TEXEL, Texels
from ..scene.camera import make_view
from ..scene.layouts import CONSTANTS
from ..scene.types import Camera
from .albedo import Albedo
from .upload.looks import Looks
from .upload.placing import Placing
from .upload.shading import Shading, view_uniforms
from .upload.surfaces import Surfaces
from .upload.trees import Trees, evaluate_trees
from .voxelize import scan

COUNT = Pass("bake/count.comp.glsl")
ROWS = Pass("bake/rows.comp.glsl")
HITS = Pass("bake/hits.comp.glsl")
STORE = Pass("bake/store.comp.glsl")
MEAN = Pass("bake/mean.comp.glsl")
PASSES = (COUNT, ROWS, HITS, STORE, MEAN)

FINEST = 256  # cells along the scene's longest side
MOST = 1 << 21  # cells
MOST_OF_SOFTWARE = 1 << 17
PART = 1 << 17  # cells at once
PART_OF_SOFTWARE = 1 << 14
PLANES = CONSTANTS["HIT_PLANES"] + CONSTANTS["POINT_PLANES"]


def bake(device: Device, placing: Placing, surfaces: Surfaces, trees: Trees, table: Albedo, shading: Shading,
         camera: Camera | None) -> Looks:
    """Evaluate the trees of all triangles, as finely as MOST allows. GpuError if the cells do not fit the device.

    surfaces  what is right for materials that are trees, and says of all others that they are none
    """
    scope = device.scope()
    traits = trees.compiled.traits
    emits = np.array([bool(t and t.emits) for t in traits], bool)
    n_rows, brightest, means = 0, 0.0, None
    if trees.passes and placing.n_work:
        with device.scope() as scratch:
            common = {**placing.geometry, "Materials": surfaces.materials["Materials"],
                      "u_n_instances": placing.n_instances}
            firsts, n_cells, cell = _cells(device, scratch, placing, common)
            n_rows = -(-placing.n_work // 2)
            texels = scope.texels("baked", TEXEL * (n_rows + n_cells))
            device.dispatch(ROWS, placing.n_work, **common, Firsts=firsts, Rows=texels.buffer, u_cell=cell)
            view = None if camera is None else make_view(camera)
            given = {**placing.geometry, **surfaces.materials, **shading.read,
                     **view_uniforms(view, placing.centre_ws), "Values": trees.values, "u_albedo": table.table,
                     "u_centre": placing.centre_ws, "u_place": np.eye(4), "u_baked": None,
                     "u_n_rows": 0}
            brightest = _evaluate(device, scratch, trees, texels, {**common, "u_n_work": placing.n_work}, given,
                                  n_rows, n_cells, cell)
            if emits.any():
                means = _means(device, scratch, placing, texels, n_rows)
    else:
        texels = scope.texels("baked", TEXEL)
    device.profiler.counts["baked bytes"] = scope.n_bytes
    return Looks(scope, {"u_baked": texels, "u_n_rows": n_rows}, brightest, means, emits)


def _cells(device: Device, scratch: GpuScope, placing: Placing, common: Resources) -> tuple[Buffer, int, float]:
    """Cells before each triangle, their number, and the side of one in metres; 0 where they are always too many."""
    most = MOST_OF_SOFTWARE if device.profiler.is_software else MOST
    n, cell = placing.n_work, placing.extent / FINEST
    counts, firsts = scratch.buffer("cells", 4 * n), scratch.buffer("first cells", 4 * n)
    while True:
        device.dispatch(COUNT, n, **common, Cells=counts, u_cell=cell)
        n_cells = scan(device, scratch, counts, n, firsts)
        if n_cells <= most or cell == 0:
            return firsts, n_cells, cell
        cell = 1.1 * cell * (n_cells / most) ** 0.5 if cell < placing.extent else 0.0


def _evaluate(device: Device, scratch: GpuScope, trees: Trees, texels: Texels, common: Resources, given: Resources,
              n_rows: int, n_cells: int, cell: float) -> float:
    """Fill in all cells; the highest radiance."""
    n_part = min(n_cells, PART_OF_SOFTWARE if device.profiler.is_software else PART)
    wave = scratch.buffer("wave of cells", 16 * PLANES * max(n_part, 1))
    unlisted = scratch.buffer("no list", 16)
    brightest = scratch.buffer("brightest", 4, clear=True)
    baked: Resources = {"u_baked": None, "u_n_rows": n_rows}
    for start in range(0, n_cells, n_part):
        n = min(n_part, n_cells - start)
        points: Resources = {"Wave": wave, "u_stride": n, "u_set": 0, "u_arrivals": 0, "u_draws": 0}
        device.dispatch(HITS, n, **common, **points, **baked, Rows=texels.buffer, u_start=start, u_cell=cell)
        slots: Resources = {"List": unlisted, "u_is_listed": False, "u_n_all": n}
        evaluate_trees(device, trees.passes, n, {**given, **points, **slots, "u_footprint": (cell, 0.0), "u_depth": 1,
                                          "u_rays": CONSTANTS["RAY_DIFFUSE"], "u_wants_mean": True,
                                          "u_may_pass": False})
        device.dispatch(STORE, n, **points, **baked, Instances=None, Triangles=None, CornerUvs=None, SlotMaterials=None,
                        Baked=texels.buffer, Brightest=brightest, u_start=start)
    return float(np.frombuffer(brightest.read(4), "f4")[0])


def _means(device: Device, scratch: GpuScope, placing: Placing, texels: Texels, n_rows: int) -> np.ndarray:
    means = scratch.buffer("means", 4 * placing.n_work)
    device.dispatch(MEAN, placing.n_work, u_baked=texels, u_n_rows=n_rows, Means=means, Instances=None, Triangles=None,
                    CornerUvs=None, SlotMaterials=None)
    return np.frombuffer(means.read(), "f4").copy()
