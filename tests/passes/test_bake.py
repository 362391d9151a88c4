# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells of triangles: bind/baked.glsl, and what passes/bake.py makes of trees."""

from __future__ import annotations

import numpy as np
import pytest

from tests.compute import evaluate

BAKED = ("bind/baked.glsl",)


@pytest.mark.parametrize("k", [1, 2, 3, 7, 255, 1024])
def test_the_middle_of_every_cell_lies_in_it(device, k):
    """So numbers and places of cells are each other's inverse."""
    cells = np.unique(np.r_[np.arange(min(k * k, 4000)), k * k - 1 - np.arange(min(k * k, 4000))]).astype("u4")
    bary = evaluate(device, "vec2", f"bary_of_cell(cell, {k}u)", BAKED, cell=cells)
    assert bary.min() > 0 and bary.sum(1).max() < 1
    assert np.array_equal(evaluate(device, "uint", f"cell_of(bary, {k}u)", BAKED, bary=bary), cells)


def test_cells_of_a_triangle_share_its_area(device):
    """Points spread evenly over a triangle fall into its k^2 cells equally often, within four deviations of chance."""
    k, n = 8, 64000
    bary = np.random.default_rng(3).dirichlet((1, 1, 1), n)[:, :2].astype("f4")
    counts = np.bincount(evaluate(device, "uint", f"cell_of(bary, {k}u)", BAKED, bary=bary), minlength=k * k)
    assert len(counts) == k * k
    assert np.abs(counts - n / k**2).max() < 4 * np.sqrt(n / k**2)


def test_packing_keeps_what_matters(device):
    """Albedos to half a step of their root, 1/2046 and 1/1023 for blue; radiance to 2^-16 of its brightest colour."""
    rng = np.random.default_rng(5)
    albedo, opacity = rng.random((500, 3)).astype("f4"), rng.random(500).astype("f4")
    emission = (rng.random((500, 3)) * 10.0 ** rng.uniform(-30, 30, (500, 1))).astype("f4")
    emission[0] = 0
    cell = "unpacked_cell(packed_cell(Cell(albedo, opacity, emission, opacity)))"
    given = {"albedo": albedo, "opacity": opacity, "emission": emission}
    found = evaluate(device, "vec3", f"{cell}.albedo", BAKED, **given)
    assert (np.abs(np.sqrt(found) - np.sqrt(albedo)) <= [2.6e-4, 2.6e-4, 5.1e-4]).all()
    assert np.array_equal(evaluate(device, "float", f"{cell}.opacity", BAKED, **given), opacity)
    found = evaluate(device, "vec3", f"{cell}.emission", BAKED, **given)
    assert (np.abs(found - emission).max(1) <= 2.0**-16 * emission.max(1) * 1.01).all()
