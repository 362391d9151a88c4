# SPDX-License-Identifier: GPL-3.0-or-later
"""Light in the voxels against closed forms, and the mip levels above them."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from svo_engine.passes.light import injection_of, light
from svo_engine.passes.upload import upload
from svo_engine.passes.voxelize import voxelize
from svo_engine.scene import layouts
from svo_engine.scene.types import Camera, Light, Material
from tests import scenes
from tests.compute import evaluate

N = 32
HALF = 2e-3  # half floats: 11 bits for the light, 8 for the opacity that multiplies it
EYE = (0.5, -2.0, 1.5)


def lit_voxels(device, scene, level: int = 0, **settings) -> tuple[np.ndarray, np.ndarray]:
    """World positions (k, 3) of the voxels' centres, relative to the scene's, and their RGBA (k, 4) f8, rgb not yet
    multiplied by opacity. At level 0 the occupied voxels, else all texels.
    """
    scene = replace(scene, camera=Camera("Camera", scenes.look(EYE), (8, 8)))
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        voxels = voxelize(device, *gpu_scene.matter, N)
        with voxels.scope:
            injection = injection_of(replace(scenes.SMALL, **settings), gpu_scene.lamps, scenes.view(scene))
            lit = light(device, gpu_scene.lamps, voxels, injection)
            with lit.scope:
                if level == 0:
                    size = layouts.dtype(layouts.VOXEL).itemsize * voxels.n_voxels
                    word = np.frombuffer(voxels.voxels.read(size), layouts.dtype(layouts.VOXEL))["voxel"]
                    cells = np.stack([word & 1023, word >> 10 & 1023, word >> 20], 1).astype("i4")
                else:
                    side = np.arange(N >> level)
                    cells = np.stack(np.meshgrid(side, side, side, indexing="ij"), -1).reshape(-1, 3).astype("i4")
                rgba = evaluate(device, "vec4", f"texelFetch(u_radiance, cell, {level})", cell=cells,
                                prelude="uniform sampler3D u_radiance;", textures={"u_radiance": lit.radiance})
                at = np.array(voxels.grid.low) + (cells + 0.5) * voxels.grid.voxel_size * 2**level
    rgba = rgba.astype("f8")
    return at, rgba if level else np.concatenate([rgba[:, :3] / np.maximum(rgba[:, 3:], 1e-9), rgba[:, 3:]], 1)


def floor_light(device, *lamps: Light, material: Material = scenes.WHITE, **settings) -> tuple[np.ndarray, np.ndarray]:
    """Positions and radiance (k, 3) of a floor's inner voxels."""
    at, rgba = lit_voxels(device, scenes.scene(scenes.Thing(scenes.floor(), material), lights=lamps), **settings)
    inner = np.abs(at[:, :2]).max(1) < 0.9
    assert np.allclose(rgba[inner, 3], 1, atol=0.01)
    return at[inner], rgba[inner, :3]


@pytest.mark.parametrize("elevation", [90, 45, 10, -30])
def test_the_sun_on_a_floor(device, elevation):
    """L = rho / pi E |cos|, from above and from below."""
    angle = np.radians(elevation)
    _, found = floor_light(device, scenes.lamp("SUN", (np.cos(angle), 0, np.sin(angle)), emitted=3.0))
    assert np.allclose(found, 0.8 / np.pi * 3 * abs(np.sin(angle)), rtol=2 * HALF)


def test_a_point_lamp_on_a_floor(device):
    """L = rho / pi I cos / d^2 at each voxel's centre."""
    lamp = scenes.lamp("POINT", (0.3, 0.2, 0.7), emitted=5.0)
    at, found = floor_light(device, lamp)
    to = np.array([0.3, 0.2, 0.7]) - at
    d2 = (to**2).sum(1)
    assert np.allclose(found[:, 0], 0.8 / np.pi * 5 * to[:, 2] / d2**1.5, rtol=2 * HALF)


def test_lamps_add_up(device):
    lamps = (scenes.lamp("POINT", (0.3, 0.2, 0.7)), scenes.lamp("SUN", (1, 2, 3)), scenes.lamp("SPOT", (0, 0, 1)))
    alone = sum(floor_light(device, lamp)[1] for lamp in lamps)
    assert np.allclose(floor_light(device, *lamps)[1], alone, rtol=2 * HALF)


def test_albedo_colours_the_light(device):
    _, found = floor_light(device, scenes.lamp("SUN", (0, 0, 1)), material=scenes.RED)
    assert np.allclose(found, np.array([0.8, 0.1, 0.1]) / np.pi, rtol=2 * HALF, atol=0.51 / 255 / np.pi)


@pytest.mark.parametrize("points", [16, 64])
def test_an_area_lamp_on_a_floor(device, points):
    """Near its axis E = pi L F with F = r^2 / (r^2 + d^2) of a disk; so few points of it are within 2 %."""
    lamp = scenes.lamp("AREA", (0, 0, 0.5), emitted=2.0, size=(0.6, 0.6), is_ellipse=True)
    at, found = floor_light(device, lamp, injection_samples=points)
    middle = np.linalg.norm(at[:, :2], axis=1).argmin()
    d = 0.5 - at[middle, 2]
    assert found[middle, 0] == pytest.approx(0.8 * 2.0 * 0.09 / (0.09 + d * d), rel=0.02)


def test_emission_and_ambient_light(device):
    """L = Le + k_a rho, without any lamp."""
    material = Material("M", (0.8, 0.4, 0.2), emission=(0, 1, 2), specular_level=0)
    _, found = floor_light(device, material=material, injection_ambient=0.5)
    assert np.allclose(found, (0.4, 1.2, 2.1), rtol=2 * HALF, atol=0.5 * 0.51 / 255)


def test_the_highlight_is_normalised_blinn_phong(device):
    """k_s (n.h)^s (s + 8) / (8 pi) E on a black floor, towards the camera."""
    lamp = scenes.lamp("SUN", (0, 1, 1), emitted=2.0)
    at, found = floor_light(device, lamp, material=scenes.BLACK, injection_specular=0.7, injection_shininess=20.0)
    wo = np.array(EYE) - at
    h = wo / np.linalg.norm(wo, axis=1, keepdims=True) + np.array([0, 1, 1]) / np.sqrt(2)
    h /= np.linalg.norm(h, axis=1, keepdims=True)
    assert np.allclose(found[:, 0], 0.7 * h[:, 2] ** 20 * 28 / (8 * np.pi) * 2, rtol=5 * HALF, atol=1e-4)


@pytest.mark.parametrize("casts_shadow", [True, False])
def test_a_roof_shadows_the_floor(device, casts_shadow):
    roof = scenes.Thing(scenes.quad("Roof", (-0.4, -0.4, 0.8), (0.8, 0, 0), (0, 0.8, 0)))
    lamp = scenes.lamp("SUN", (0, 0, 1), casts_shadow=casts_shadow)
    at, rgba = lit_voxels(device, scenes.scene(scenes.Thing(scenes.floor()), roof, lights=(lamp,)))
    voxel = 2 / 27
    on_floor, distance = at[:, 2] < 0, np.abs(at[:, :2]).max(1)
    covered, free = on_floor & (distance < 0.4 - voxel), on_floor & (distance > 0.4 + 2 * voxel) & (distance < 0.9)
    assert np.allclose(rgba[free, 0], 0.8 / np.pi, rtol=2 * HALF)
    assert np.allclose(rgba[covered, 0], 0 if casts_shadow else 0.8 / np.pi, rtol=2 * HALF)
    assert np.allclose(rgba[~on_floor & (distance < 0.3), 0], 0.8 / np.pi, rtol=2 * HALF)


def test_a_lamp_just_over_the_floor_is_not_shadowed_by_it(device):
    """Nor by the voxel that it lies in."""
    _, found = floor_light(device, scenes.lamp("POINT", (0, 0, 0.3)))
    assert found.min() > 0


def test_light_beyond_half_floats_is_cut_off(device):
    _, found = floor_light(device, scenes.lamp("SUN", (0, 0, 1), emitted=1e9))
    assert np.isfinite(found).all()
    assert found.max() <= 65504 * 1.01


def test_every_level_is_the_mean_of_eight(device):
    scene = scenes.cornell()
    levels = [lit_voxels(device, scene, level)[1].reshape(*[N >> level] * 3, 4) for level in (1, 2, 3, 4, 5)]
    for fine, coarse in pairwise(levels):
        m = len(coarse)
        mean = fine.reshape(m, 2, m, 2, m, 2, 4).mean((1, 3, 5))
        assert np.allclose(coarse, mean, rtol=1e-3, atol=1e-6)  # one more rounding to 11 bits
    _, rgba = lit_voxels(device, scene)
    opacity = rgba[:, 3].sum() / N**3
    assert levels[-1][0, 0, 0, 3] == pytest.approx(opacity, rel=5e-3)
    assert levels[-1][0, 0, 0, 0] == pytest.approx((rgba[:, 0] * rgba[:, 3]).sum() / N**3, rel=5e-3)
