# SPDX-License-Identifier: GPL-3.0-or-later
"""lib/brdf.glsl: the terms alone, and what they add up to."""

from __future__ import annotations

import numpy as np
import pytest

from tests.compute import evaluate

BRDF = ("lib/brdf.glsl",)


@pytest.mark.parametrize(("roughness", "tolerance"), [(0.1, 5e-3), (0.3, 1e-4), (0.7, 1e-5), (1.0, 1e-5)])
def test_the_normals_of_ggx_cover_the_surface_once(device, roughness, tolerance):
    """int D NoH dw = 1. With s = x / (1 + x), x = (tan / alpha)^2 the integrand is exactly 1 / s' = const, so that the
    mean over midpoints of s is the integral. f4 keeps alpha^2 = 1e-4 beside 1 to 1e-3 in the narrowest lobe.
    """
    alpha = roughness**2
    s = (np.arange(2000) + 0.5) / 2000
    cos2 = 1 / (1 + alpha**2 * s / (1 - s))
    found = evaluate(device, "float", "d_ggx(c, a)", BRDF, c=np.sqrt(cos2).astype("f4"), a=np.full(2000, alpha, "f4"))
    # D NoH dw = D cos 2 pi sin dtheta = D pi dx alpha^2 cos^4, dx = ds / (1 - s)^2
    assert (found * np.pi * alpha**2 * cos2**2 / (1 - s) ** 2).mean() == pytest.approx(1, rel=tolerance)


def test_fresnel_goes_from_f0_to_one(device):
    cosines = np.array([1, 1.5, 0, -0.5, 0.5], "f4")
    found = evaluate(device, "vec3", "f_schlick(vec3(0.04, 0.5, 1.0), c)", BRDF, c=cosines)
    half = 0.5**5
    expected = np.array([0.04, 0.5, 1.0])
    assert np.allclose(found, [expected, expected, [1, 1, 1], [1, 1, 1], expected + (1 - expected) * half], atol=1e-6)


def angles(n: int = 4000):
    """Random wo, wi above the surface and their half vector: NoH, NoV, NoL, VoH as f4."""
    rng = np.random.default_rng(1)
    v, light = rng.normal(size=(2, n, 3))
    for d in (v, light):
        d /= np.linalg.norm(d, axis=1, keepdims=True)
        d[:, 2] = np.abs(d[:, 2])
    h = v + light
    h /= np.linalg.norm(h, axis=1, keepdims=True)
    return {"nh": h[:, 2].astype("f4"), "nv": v[:, 2].astype("f4"), "nl": light[:, 2].astype("f4"),
            "vh": (v * h).sum(1).astype("f4")}


def test_shadowing_is_a_share(device):
    g = evaluate(device, "float", "g_cook_torrance(nh, nv, nl, vh)", BRDF, **angles())
    assert g.min() >= 0 and g.max() <= 1
    assert evaluate(device, "float", "g_cook_torrance(x, x, x, x)", BRDF, x=np.ones(1, "f4"))[0] == 1


def test_the_brdf_is_reciprocal_and_finite(device):
    found = [evaluate(device, "vec3", f"microfacet_brdf(vec3(0.04), 0.25, nh, {pair}, vh)", BRDF, **angles())
             for pair in ("nv, nl", "nl, nv")]
    assert np.isfinite(found[0]).all() and found[0].min() >= 0
    assert np.allclose(found[0], found[1], rtol=1e-5)


@pytest.mark.parametrize(("ior", "level", "f0"), [(1.5, 0.5, 0.04), (1.5, 1.0, 0.08), (1.5, 0.0, 0.0), (9.0, 1.0, 1.0)])
def test_the_specular_level_scales_the_reflectance(device, ior, level, f0):
    found = evaluate(device, "float", "dielectric_f0(n, l)", BRDF, n=np.array([ior], "f4"), l=np.array([level], "f4"))
    assert found[0] == pytest.approx(f0, abs=1e-6)
