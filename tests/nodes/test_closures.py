# SPDX-License-Identifier: GPL-3.0-or-later
"""Closures: mixtures are right in the mean, none makes light, white ones keep it, and grounds share it out."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from svo_engine.passes.albedo import albedo
from svo_engine.passes.upload.surfaces import _materials
from svo_engine.scene.types import Material
from tests.compute import evaluate

INCLUDES, TABLE = ("nodes/closures_principled.glsl",), ("bind/principled.glsl",)
PRELUDE = """
Geo geo_of(float c, bool is_back)
{
    Geo g;
    g.normal = g.normal_geometric = vec3(0.0, 0.0, 1.0);
    g.wo = vec3(sqrt(max(1.0 - c * c, 0.0)), 0.0, c);
    g.is_back = is_back;
    return g;
}
const vec3 UP = vec3(0.0, 0.0, 1.0);
Closures principled_of(float chance, float c, vec3 color, vec4 a, vec4 b, vec4 d, vec3 tint)
{
    Geo g = geo_of(c, false);
    Closures k = no_closures(g, chance, false);
    closure_principled(k, 1.0, g, color, a.x, a.y, 1.0 + a.z, 1.0, UP, a.w, b.x, b.y, tint, b.z, 0.0,
                       vec3(1.0, 0.0, 0.0), b.w, d.x, d.y, 1.5, vec3(1.0), UP, d.z, d.w, tint, vec3(0.0), 0.0, true);
    return k;
}
vec3 sent_back(Closures k)
{
    return k.ground + k.lobes.glossy + k.lobes.transmission + k.behind;
}
// Two metals, a sheen and a rough ground, each of another kind
Closures mixture(float chance, float c)
{
    Geo g = geo_of(c, false);
    Closures k = no_closures(g, chance, false);
    closure_metallic(k, 0.3, g, vec3(0.9, 0.5, 0.1), vec3(1.0), 0.2, 0.0, 0.0, UP, vec3(0.0), true);
    closure_metallic(k, 0.2, g, vec3(0.1, 0.5, 0.9), vec3(1.0), 0.7, 0.0, 0.0, UP, vec3(0.0), true);
    closure_diffuse(k, 0.3, g, vec3(0.2, 0.8, 0.4), 0.7, UP);
    closure_diffuse(k, 0.2, g, vec3(0.7, 0.1, 0.1), 0.0, UP);
    return k;
}
"""
N = 4096


@cache
def table(device) -> dict[str, Any]:
    """One for all tests."""
    return {"u_albedo": albedo(device, True).table}


def found(device, type_: str, call: str, **inputs: Any) -> np.ndarray:
    return evaluate(device, type_, call, INCLUDES, PRELUDE, textures=table(device), **inputs)


def of_table(device, call: str, **inputs: Any) -> np.ndarray:
    return evaluate(device, "vec3", call, TABLE, textures=table(device), **inputs)


def rows(n: int, *values: float) -> np.ndarray:
    return np.repeat(np.array(values, "f4")[None], n, 0)


CHANCES = ((np.arange(N) + 0.5) / N).astype("f4")


def test_a_mixture_is_right_in_the_mean(device):
    """Of what is kept by chance and divided by its probability, over even chances: 1 / N of each of three coins."""
    c = np.full(N, 0.6, "f4")
    ground = found(device, "vec3", "mixture(x, c).ground", x=CHANCES, c=c)
    expected = 0.3 * np.array([0.2, 0.8, 0.4]) + 0.2 * np.array([0.7, 0.1, 0.1])
    assert np.allclose(ground.mean(0), expected, rtol=3e-3)
    assert len(np.unique(ground.round(5), axis=0)) == 2
    lobes = found(device, "vec3", "mixture(x, c).lobes.glossy", x=CHANCES, c=c)
    assert len(np.unique(lobes.round(5), axis=0)) == 2
    masses = lobes.mean(1)
    assert np.allclose(masses, masses.mean(), rtol=1e-4)  # either is worth as much


def test_like_closures_are_summed_without_chance(device):
    """Two grounds of Lambert's and two metals of one roughness."""
    prelude = PRELUDE + """
    Closures pair(float chance)
    {
        Geo g = geo_of(0.6, false);
        Closures k = no_closures(g, chance, false);
        closure_metallic(k, 0.3, g, vec3(0.9, 0.5, 0.1), vec3(1.0), 0.2, 0.0, 0.0, UP, vec3(0.0), true);
        closure_metallic(k, 0.2, g, vec3(0.1, 0.5, 0.9), vec3(1.0), 0.2, 0.0, 0.0, UP, vec3(0.0), true);
        closure_diffuse(k, 0.3, g, vec3(0.2, 0.8, 0.4), 0.0, UP);
        closure_diffuse(k, 0.2, g, vec3(0.7, 0.1, 0.1), 0.0, UP);
        return k;
    }
    """
    for field in ("ground", "lobes.glossy", "lobes.metal_f0"):
        values = evaluate(device, "vec3", f"pair(x).{field}", INCLUDES, prelude, textures=table(device),
                          x=CHANCES[::64])
        assert np.ptp(values, axis=0).max() == 0
        assert values.min() > 0


@pytest.mark.parametrize("material", [
    Material("Coat", (0.8, 0.3, 0.1), roughness=0.3), Material("Metal", (0.8, 0.3, 0.1), metallic=1.0, roughness=0.4),
    Material("Glass", (0.8, 0.3, 0.1), transmission=1.0, roughness=0.1),
    Material("All", (0.8, 0.3, 0.1), metallic=0.3, transmission=0.5, roughness=0.5, specular_tint=(1, 0.5, 0.2))])
def test_plain_values_give_what_the_table_of_materials_does(device, material):
    n, c = 16, np.linspace(0.05, 1, 16).astype("f4")
    inputs = {"c": c, "x": np.full(n, 0.5, "f4"), "color": rows(n, *material.base_color),
              "a": rows(n, material.metallic, material.roughness, material.ior - 1, 0),
              "b": rows(n, 0, material.specular_level, 0, material.transmission), "d": rows(n, 0, 0, 0, 0.5),
              "tint": rows(n, *material.specular_tint)}
    m = np.repeat(_materials((material,)), n)
    shading = "Shading(m.base_color, 1.0, m.emission, m.roughness, m.metallic)"
    for ours, theirs in (("ground", "diffuse"), *((f"lobes.{f}", f) for f in (
            "glossy", "transmission", "metal_f0", "metal_dip", "coat_f0", "coat_f90", "glass_f90", "glass_through"))):
        made = found(device, "vec3", f"principled_of(x, c, color, a, b, d, tint).{ours}", **inputs)
        plain = of_table(device, f"principled(m, {shading}, c, false).{theirs}", m=m, c=c)
        assert np.allclose(made, plain, atol=1e-5), ours
    mean = found(device, "vec3", "principled_of(x, c, color, a, b, d, tint).mean", **inputs)
    assert np.allclose(mean, of_table(device, f"mean_albedo(m, {shading})", m=m, c=c), atol=1e-5)


def any_principled(n: int) -> dict[str, Any]:
    """Random parameters; half of all weights are zero."""
    rng = np.random.default_rng(1)
    a, b, d = (rng.random((n, 4)) for _ in range(3))
    for values in (a[:, 0], a[:, 3], b[:, 0], b[:, 2], b[:, 3], d[:, 0], d[:, 2]):
        values *= rng.random(n) < 0.5
    return {"x": rng.random(n), "c": rng.uniform(1e-3, 1, n), "color": rng.random((n, 3)), "a": a, "b": b, "d": d,
            "tint": rng.random((n, 3))}


def test_no_principled_makes_light(device):
    """In the mean over its coins, of which there are up to two; 64 chances each."""
    n = 400
    inputs = {name: np.repeat(v, 64, 0).astype("f4") for name, v in any_principled(n).items()}
    inputs["x"] = np.tile((np.arange(64) + 0.5) / 64, n).astype("f4")
    back = found(device, "vec3", "sent_back(principled_of(x, c, color, a, b, d, tint))", **inputs)
    assert np.isfinite(back).all()
    assert back.min() >= 0
    assert back.reshape(n, 64, 3).mean(1).max() < 1.01
    mean = found(device, "vec3", "principled_of(x, c, color, a, b, d, tint).mean", **inputs)
    assert mean.min() >= 0
    assert mean.max() < 1.005


@pytest.mark.parametrize("coat", [0.0, 1.0])
@pytest.mark.parametrize("sheen", [0.0, 1.0])
def test_a_white_principled_sends_everything_back(device, coat, sheen):
    """Coat, sheen, dielectric and rough ground in white, over all chances."""
    n = 256
    for c in (0.2, 0.6, 1.0):
        back = found(device, "vec3", "sent_back(principled_of(x, c, color, a, b, d, tint))",
                     x=((np.arange(n) + 0.5) / n).astype("f4"), c=np.full(n, c, "f4"), color=rows(n, 1, 1, 1),
                     a=rows(n, 0, 0.4, 0.5, 0), b=rows(n, 0, 0.5, 0, 0), d=rows(n, coat, 0.1, sheen, 0.5),
                     tint=rows(n, 1, 1, 1))
        assert back.mean() == pytest.approx(1, abs=0.01)


SHAPES = {"oren_nayar": "rough_ground(vec3(1.0), 0.8, v)",
          "sheen": "Shape(SHAPE_SHEEN, sheen_transform(v, 0.5), vec3(0.0))",
          "toon": "Shape(SHAPE_TOON, vec2(0.7, 0.4), vec3(0.0))"}


@pytest.mark.parametrize("cosine", [0.3, 0.8])
@pytest.mark.parametrize("name", SHAPES)
def test_shapes_share_out_all_light(device, name, cosine):
    """int f cos dw over albedo, by 300 x 300 directions distributed as the cosine: 1; a toon's fading part is lost."""
    u = (np.arange(300) + 0.5) / 300
    r2, phi = np.meshgrid(u, 2 * np.pi * u)
    wi = np.stack([np.sqrt(r2) * np.cos(phi), np.sqrt(r2) * np.sin(phi), np.sqrt(1 - r2)], -1)
    wi = wi.reshape(-1, 3).astype("f4")
    v = np.full(len(wi), cosine, "f4")
    factor = found(device, "vec3", f"shape_factor({SHAPES[name]}, UP, geo_of(v, false).wo, wi)", wi=wi, v=v)
    share = found(device, "float", "toon_share(vec2(0.7, 0.4))", v=v[:1])[0] if name == "toon" else 1.0
    assert np.isfinite(factor).all()
    assert factor.mean() == pytest.approx(share, rel=0.01)
