# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of albedos, and what materials make of it: no surface takes light or makes it, white ones send all back."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from svo_engine.passes.albedo import albedo
from svo_engine.passes.upload.surfaces import _materials
from svo_engine.scene.types import Material
from tests.compute import evaluate

INCLUDES = ("bind/principled.glsl",)
PRELUDE = """
Bsdf bsdf_of(Material m, float c, bool is_back)
{
    return principled(m, Shading(m.base_color, 1.0, m.emission, m.roughness, m.metallic), c, is_back);
}
vec3 drawn_weight(Material m, float c, bool is_back, uint i)
{
    vec3 wo = vec3(sqrt(1.0 - c * c), 0.0, c);
    return sample_specular(bsdf_of(m, c, is_back), wo, sobol_point(i, 1u), sobol_point(i, 7u).x).weight;
}
"""
ROUGHNESSES = (0.0, 0.03, 0.1, 0.3, 0.5, 0.75, 1.0)
COSINES = (0.1, 0.3, 0.6, 1.0)
METAL = Material("Metal", (1, 1, 1), metallic=1.0)
GLASS = Material("Glass", (1, 1, 1), transmission=1.0)
VARNISH = Material("Varnish", (1, 1, 1))
N = 65536  # directions of an albedo. Between columns and rows of the table, and of so many directions: 1 %


@cache
def table(device) -> dict[str, Any]:
    """One for all tests."""
    return {"u_albedo": albedo(device, True).table}


def drawn_albedo(device, material: Material, c: float, is_back: bool = False) -> np.ndarray:
    """(3,): mean weight of N directions, what the surface sends back of light 1 from everywhere but by its ground."""
    found = evaluate(device, "vec3", f"drawn_weight(m, c, {str(is_back).lower()}, i)", INCLUDES, PRELUDE,
                     textures=table(device), m=np.repeat(_materials((material,)), N), c=np.full(N, c, "f4"),
                     i=np.arange(N, dtype="u4"))
    return found.mean(0)


def of_bsdf(device, material: Material, field: str, c: float) -> np.ndarray:
    return evaluate(device, "vec3", f"bsdf_of(m, c, false).{field}", INCLUDES, PRELUDE, textures=table(device),
                    m=_materials((material,)), c=np.full(1, c, "f4"))[0]


@pytest.mark.parametrize("c", COSINES)
@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_a_white_metal_sends_everything_back(device, roughness, c):
    assert drawn_albedo(device, replace(METAL, roughness=roughness), c) == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("is_back", [False, True])
@pytest.mark.parametrize("c", COSINES)
@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_white_glass_sends_everything_on(device, roughness, c, is_back):
    assert drawn_albedo(device, replace(GLASS, roughness=roughness), c, is_back) == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("ior", [1.2, 1.5, 2.5])
@pytest.mark.parametrize("c", COSINES)
@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_a_coat_and_its_white_ground_send_everything_back(device, roughness, c, ior):
    material = replace(VARNISH, roughness=roughness, ior=ior)
    ground = of_bsdf(device, material, "diffuse", c)
    assert drawn_albedo(device, material, c) + ground == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("material", [
    replace(METAL, base_color=(0.9, 0.5, 0.1)), replace(METAL, base_color=(0.9, 0.5, 0.1), specular_tint=(1, 0.3, 0.6)),
    replace(VARNISH, specular_tint=(1, 0.5, 0)), replace(VARNISH, specular_level=1.0), replace(VARNISH, metallic=0.5)])
@pytest.mark.parametrize("roughness", [0.1, 0.5, 1.0])
def test_the_albedo_is_that_of_what_is_drawn(device, material, roughness):
    material = replace(material, roughness=roughness)
    for c in (0.2, 0.7):
        found = of_bsdf(device, material, "glossy", c)
        assert np.allclose(found, drawn_albedo(device, material, c), atol=0.01)


def test_no_material_makes_light(device):
    rng = np.random.default_rng(1)
    n = 2000
    materials = _materials(tuple(Material(
        "Any", tuple(rng.random(3)), rng.random(), float(rng.choice([0, 1, rng.random()])), float(1 + 2 * rng.random()),
        rng.random(), tuple(rng.random(3)), float(rng.choice([0, 1, rng.random()]))) for _ in range(n)))
    c = rng.uniform(1e-3, 1, n).astype("f4")
    inputs = {"m": materials, "c": c, "i": np.arange(n, dtype="u4")}
    found = sum(evaluate(device, "vec3", f"bsdf_of(m, c, i % 2 == 0).{field}", INCLUDES, PRELUDE,
                         textures=table(device), **inputs) for field in ("diffuse", "glossy", "transmission"))
    assert np.isfinite(found).all() and found.min() >= 0
    assert found.max() < 1.005


@pytest.mark.parametrize("material", [
    VARNISH, replace(VARNISH, base_color=(0.8, 0.2, 0.02)), replace(VARNISH, specular_tint=(1, 0.5, 0), ior=2.0),
    replace(METAL, base_color=(0.9, 0.5, 0.1)), replace(METAL, metallic=0.3), replace(VARNISH, transmission=0.4)])
@pytest.mark.parametrize("roughness", [0.1, 0.5, 1.0])
def test_the_mean_albedo_is_that_of_all_directions(device, material, roughness):
    """2 int albedo cos dcos by 64 midpoints, glass left out. A metal goes by the mean of a smooth one: 0.025."""
    c = ((np.arange(64) + 0.5) / 64).astype("f4")
    rows = _materials((replace(material, roughness=roughness),) * 64)
    opaque, mean = (evaluate(device, "vec3", call, INCLUDES, PRELUDE, textures=table(device), m=rows, c=c) for call in (
        "bsdf_of(m, c, false).diffuse + bsdf_of(m, c, false).glossy",
        "mean_albedo(m, Shading(m.base_color, 1.0, m.emission, m.roughness, m.metallic))"))
    if material.transmission:
        glass = evaluate(device, "vec3", "m.transmission * f_dielectric(c, m.ior) * vec3(1.0)", INCLUDES, m=rows, c=c)
        opaque -= glass
    assert np.allclose(mean[0], (2 * c[:, None] * opaque).mean(0), atol=0.025)


def split_sum(roughness: float, nv: float, n: int = 256) -> tuple[float, float]:
    """Scale and bias on f0 of the reflectance under uniform light, by n^2 half vectors drawn from D h.z."""
    u, phi = np.meshgrid((np.arange(n) + 0.5) / n, 2 * np.pi * (np.arange(n) + 0.5) / n)
    a2 = roughness**4
    nh = np.sqrt((1 - u) / (1 + (a2 - 1) * u))
    vh = np.sqrt(1 - nv**2) * np.sqrt(1 - nh**2) * np.cos(phi) + nv * nh
    nl = np.maximum(2 * vh * nh - nv, 0)
    g2 = 2 * nl * nv / (nl * np.sqrt(a2 + (1 - a2) * nv**2) + nv * np.sqrt(a2 + (1 - a2) * nl**2))
    weight = np.where((nl > 0) & (vh > 0), g2 * vh / (nh * nv), 0)
    fresnel = np.clip(1 - vh, 0, 1) ** 5
    return float((weight * (1 - fresnel)).mean()), float((weight * fresnel).mean())


def test_the_environment_brdf_is_its_integral(device):
    roughness, nv = (a.ravel().astype("f4") for a in np.meshgrid([0.2, 0.4, 0.6, 0.8, 1.0], [0.2, 0.4, 0.7, 1.0]))
    found = evaluate(device, "vec2", "environment_brdf(r, c)", INCLUDES, textures=table(device), r=roughness, c=nv)
    expected = [split_sum(r, c) for r, c in zip(roughness.tolist(), nv.tolist(), strict=True)]
    assert np.allclose(found, expected, atol=5e-3)


def test_scenes_without_mirrors_do_without_a_table(device):
    made = albedo(device, False)
    assert made.table.size[:2] == (1, 1)
    made.scope.close()
