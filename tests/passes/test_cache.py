# SPDX-License-Identifier: GPL-3.0-or-later
"""The light on both sides of the surfels against closed forms."""

from __future__ import annotations

from math import ceil, log, pi

import numpy as np
import pytest

from svo_engine.gpu import device as device_module
from svo_engine.passes.cache import TOLERANCE
from svo_engine.scene.types import World
from tests import scenes
from tests.rays import glow, rectangle_share
from tests.surfels import Lit, lit_surfels

N = 32
UNIT = 1e-4  # octahedral normals: shaders/lib/math.glsl
MAX_ALBEDO = 0.9999  # shaders/octree/blend.comp.glsl
TOP, BOTTOM = 0, 1  # sides of a level surfel


def lit_floor(device, *lamps, material=scenes.WHITE, **settings) -> Lit:
    return lit_surfels(device, scenes.scene(scenes.Thing(scenes.floor(), material), lights=lamps), N, **settings)


@pytest.mark.parametrize("elevation", [90, 45, 10])
def test_the_sun_lights_the_side_that_faces_it(device, elevation):
    """E cos on one side, nothing on the other."""
    angle = np.radians(elevation)
    lit = lit_floor(device, scenes.lamp("SUN", (np.cos(angle), 0, np.sin(angle)), emitted=3.0))
    assert np.allclose(lit.lamps[:, TOP], 3 * np.sin(angle), atol=3 * UNIT)
    assert not lit.lamps[:, BOTTOM].any()
    assert np.allclose(lit.radiance[:, TOP], 0.8 / pi * 3 * np.sin(angle), atol=UNIT)


def test_a_point_lamp(device):
    """I cos / d^2 at each surfel's own position, so that no resolution is lost."""
    at = np.array([0.3, 0.2, 0.7])
    lit = lit_floor(device, scenes.lamp("POINT", at, emitted=5.0))
    to = at - lit.surfels.positions
    expected = 5 * to[:, 2] / np.linalg.norm(to, axis=1) ** 3
    assert np.allclose(lit.lamps[:, TOP, 0], expected, rtol=3 * UNIT, atol=5 * UNIT)


def test_a_rectangle(device):
    """E = pi L F. Points spread evenly are no worse than random ones, of which one in two million is 5 sigma off."""
    points, z, low, high = 16, 0.5, (-0.1, 0.0), (0.5, 0.4)
    lamp = scenes.lamp("AREA", (0.2, 0.2, z), (0.2, 0.2, 0), emitted=2.0, size=(0.6, 0.4))
    lit = lit_floor(device, lamp, points=points)
    p = lit.surfels.positions
    expected = 2 * pi * rectangle_share(p, low, high, z)
    x, y = (part.ravel() for part in np.meshgrid(np.linspace(-0.1, 0.5, 24), np.linspace(0, 0.4, 24)))
    terms = 2 * 0.24 * z**2 / ((x - p[:, :1]) ** 2 + (y - p[:, 1:2]) ** 2 + z**2) ** 2
    error, sigma = lit.lamps[:, TOP, 0] - expected, terms.std(1) / np.sqrt(points) + UNIT * expected
    assert (np.abs(error) < 5 * sigma).all()
    assert abs(error.mean()) < 4 * np.sqrt((sigma**2).mean() / len(sigma)) + UNIT


def test_a_roof_shadows_surfels_exactly(device):
    roof = scenes.Thing(scenes.quad("Roof", (-0.4, -0.4, 0.8), (0.8, 0, 0), (0, 0.8, 0)), scenes.BLACK)
    lamp = scenes.lamp("SUN", (0, 0, 1), emitted=1.0)
    lit = lit_surfels(device, scenes.scene(scenes.Thing(scenes.floor()), roof, lights=(lamp,)), N)
    p = lit.surfels.positions
    on_floor, covered = p[:, 2] < 0.1, np.abs(p[:, :2]).max(1) < 0.4
    assert not lit.lamps[on_floor & covered].any()
    assert np.allclose(lit.lamps[on_floor & ~covered, TOP], 1, atol=UNIT)
    assert np.allclose(lit.lamps[~on_floor, TOP], 1, atol=UNIT)
    assert (on_floor & covered).sum() > 50 and (~on_floor).sum() > 50


def test_albedo_colours_what_is_sent_and_emission_is_added(device):
    lit = lit_floor(device, scenes.lamp("SUN", (0, 0, 1)), material=scenes.RED, bounces=0)
    assert np.allclose(lit.radiance[:, TOP], np.array([0.8, 0.1, 0.1]) / pi, atol=UNIT)
    assert np.allclose(lit_floor(device, material=glow(3.0, 0.5)).radiance, 3, rtol=UNIT)


def test_the_sky_brings_pi_times_its_radiance(device):
    """On both sides of a floor that sees nothing else, whatever the rays."""
    scene = scenes.scene(scenes.Thing(scenes.floor()), world=World((1, 2, 3)))
    lit = lit_surfels(device, scene, N, rays=3)
    assert np.allclose(lit.indirect, pi * np.array([1, 2, 3]), rtol=1e-5)
    assert not lit.lamps.any()


def inner(lit: Lit) -> np.ndarray:
    """The radiance (n, 3) of the sides that see the inside of a box around the origin; not where two of its faces meet,
    as these share voxels.
    """
    p, n = lit.surfels.positions, lit.surfels.normals
    side = (np.einsum("ni,ni->n", p, n) > 0).astype(int)
    clear = np.sort(np.abs(p), axis=1)[:, 1] < 0.85
    assert clear.sum() > 100
    return lit.radiance[np.arange(len(p)), side][clear]


def closed_box(rho: float):
    """Walls of a closed box that send out 1 and reflect rho."""
    return scenes.scene(scenes.Thing(scenes.box("Box", (-1, -1, -1), (1, 1, 1)), glow(1.0, rho)))


@pytest.mark.parametrize("rho", [0.2, 0.5, 0.8])
def test_every_bounce_in_a_furnace_is_one_term_of_its_series(device, rho):
    """L = Le (1 + rho + rho^2 + ...), whatever the rays."""
    found = inner(lit_surfels(device, closed_box(rho), N, rays=2, bounces=3))
    assert np.allclose(found, sum(rho**k for k in range(4)), rtol=1e-4)


@pytest.mark.parametrize("rho", [0.2, 0.5, 0.8])
def test_bounces_end_at_the_tolerance(device, rho):
    """Bounce k adds rho^k; the first is the largest. What is left out is rho / (1 - rho) of the last one."""
    lit = lit_surfels(device, closed_box(rho), N, rays=2, bounces=64)
    assert lit.n_bounces == ceil(log(TOLERANCE) / log(rho)) + 1
    assert np.allclose(inner(lit), 1 / (1 - rho), rtol=TOLERANCE * rho**2 + 1e-4)


def test_white_walls_stay_finite_and_get_no_darker(device):
    """With nothing absorbed, k bounces add up to k + 1; as much as nothing is."""
    previous = np.zeros(1)
    for k in (8, 16, 64):
        found = inner(lit_surfels(device, closed_box(1.0), N, rays=1, bounces=k))
        assert np.allclose(found, sum(MAX_ALBEDO**j for j in range(k + 1)), rtol=1e-3)
        assert found.min() > previous.max()
        previous = found


def test_without_light_one_sweep_finds_nothing(device):
    lit = lit_surfels(device, scenes.cornell(), N)
    dark = lit_surfels(device, scenes.scene(*scenes.room()), N, bounces=64)
    assert lit.n_bounces > 1 and lit.radiance.max() > 0
    assert dark.n_bounces == 1 and not dark.radiance.any()


def test_no_bounce_leaves_what_the_lamps_bring(device):
    lit = lit_surfels(device, scenes.cornell(), N, bounces=0)
    assert lit.n_bounces == 0
    assert lit.lamps.any() and not lit.indirect.any()


def test_two_sides_of_a_wall_know_nothing_of_each_other(device):
    """One room is sunlit through its open front, the other is closed. No surfel in the closed one gets light."""
    dark = scenes.Thing(scenes.box("Dark", (0, -1, -1), (2, 1, 1)))
    lit_room = [scenes.Thing(scenes.quad(name, *shape)) for name, shape in {
        "Floor": ((-2, -1, -1), (2, 0, 0), (0, 2, 0)), "Ceiling": ((-2, -1, 1), (0, 2, 0), (2, 0, 0))}.items()]
    sun = scenes.lamp("SUN", (-1, -0.2, 0), emitted=5.0)
    lit = lit_surfels(device, scenes.scene(dark, *lit_room, lights=(sun,)), N)
    p, n = lit.surfels.positions, lit.surfels.normals
    for side, facing in ((0, n), (1, -n)):
        inside = (np.abs(p + 0.01 * facing - (1, 0, 0)) < 1).all(1)
        assert inside.sum() > 100
        assert not lit.lamps[inside, side].any()
        assert lit.radiance[inside, side].max() < 1e-3 * lit.radiance.max()
    on_wall = (np.abs(p) < (1e-3, 0.9, 0.9)).all(1) & (lit.surfels.keys[:, 3] == 0)
    assert on_wall.sum() > 100
    assert lit.lamps[on_wall, 1].min() > 1


@pytest.mark.parametrize("scale_x", [1.0, -1.0])
@pytest.mark.parametrize("thickness", [0.02, 0.2, 0.5, 0.9])
def test_a_board_thinner_than_a_voxel_is_lit_from_outside(device, thickness, scale_x):
    """Both its faces may be one surfel, whose mean position lies inside the board, where it is dark. A negative scale
    turns the winding of triangles, not their faces.
    """
    half = thickness / (N - 5)
    board = scenes.Thing(scenes.box("Board", (-1, -1, -half), (1, 1, half)), places=(np.diag([scale_x, 1, 1, 1]),))
    lamps = scenes.lamp("SUN", (0, 0, 1), emitted=1.0), scenes.lamp("SUN", (0, 0, -1), emitted=2.0)
    lit = lit_surfels(device, scenes.scene(board, lights=lamps), N)
    level = (lit.surfels.keys[:, 3] == 2) & (np.abs(lit.surfels.positions[:, :2]).max(1) < 0.9)
    z = lit.surfels.keys[level, 2]
    assert np.allclose(lit.lamps[level][z == z.max(), TOP], 1, atol=2 * UNIT)
    assert np.allclose(lit.lamps[level][z == z.min(), BOTTOM], 2, atol=2 * UNIT)


def test_light_is_the_same_bits_however_the_work_is_cut(device, monkeypatch):
    scene = scenes.cornell()
    first = lit_surfels(device, scene, N, rays=2).bits
    assert lit_surfels(device, scene, N, rays=2).bits == first
    monkeypatch.setattr(device_module, "FIRST_SLICE", 512)
    monkeypatch.setattr(device_module, "SLICE_SECONDS", 1e-9)
    monkeypatch.setattr(device, "_per_second", {})
    assert lit_surfels(device, scene, N, rays=2).bits == first


def test_an_empty_scene_has_no_light(device):
    lit = lit_surfels(device, scenes.scene(lights=(scenes.lamp("SUN", (0, 0, 1)),)), N)
    assert len(lit.radiance) == 0
