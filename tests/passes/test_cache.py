# SPDX-License-Identifier: GPL-3.0-or-later
"""The light on both sides of the surfels against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.scene.types import Material
from tests import scenes
from tests.surfels import lit_surfels

UNIT = 1e-4  # octahedral normals: shaders/lib/math.glsl


@pytest.mark.parametrize("elevation", [90, 45, 10])
def test_the_sun_lights_the_side_that_faces_it(device, elevation):
    """E cos on one side, nothing on the other."""
    angle = np.radians(elevation)
    lamp = scenes.lamp("SUN", (np.cos(angle), 0, np.sin(angle)), emitted=3.0)
    lit = lit_surfels(device, scenes.scene(scenes.Thing(scenes.floor()), lights=(lamp,)))
    assert np.allclose(lit.lamps[:, 0], 3 * np.sin(angle), atol=3 * UNIT)
    assert not lit.lamps[:, 1].any()
    assert np.allclose(lit.radiance[:, 0], 0.8 / np.pi * 3 * np.sin(angle), atol=UNIT)


@pytest.mark.parametrize("rho", [0.2, 0.8])
def test_a_furnace_is_as_bright_everywhere_as_its_series(device, rho):
    """L = Le (1 + rho + rho^2 + ...) whatever the rays; k bounces give its first k + 1 terms."""
    glow = Material("Glow", (rho, rho, rho), emission=(1, 1, 1), specular_level=0)
    scene = scenes.scene(scenes.Thing(scenes.box("Box", (-1, -1, -1), (1, 1, 1)), glow))
    lit = lit_surfels(device, scene, bounces=3, rays=4)
    inside = lit.radiance[:, :, 0][np.einsum("ni,ni->n", lit.surfels.normals, lit.surfels.positions) > 0, 1]
    assert len(inside) > 100
    series = sum(rho**k for k in range(4))
    assert np.median(inside) == pytest.approx(series, rel=1e-4)
