# SPDX-License-Identifier: GPL-3.0-or-later
"""lib/ggx.glsl and lib/bsdf.glsl: the terms alone; what is drawn against what is evaluated."""

from __future__ import annotations

import numpy as np
import pytest

from tests.compute import evaluate

GGX, BSDF = ("lib/ggx.glsl",), ("lib/bsdf.glsl",)

# Half coat, half glass, each with its own colour; `alpha` and `eta` are inputs
MIXED = """
Bsdf mixed(float alpha, float eta)
{
    Bsdf b = no_lobes(vec2(alpha));
    b.metal_f0 = 0.3 * vec3(0.9, 0.6, 0.3);
    b.metal_f90 = vec3(0.3);
    b.metal_dip = vec3(0.03);
    b.coat_f0 = vec3(0.01);
    b.coat_f90 = vec3(0.2);
    b.coat_eta = 1.5;
    b.glass_f0 = vec3(0.02);
    b.glass_f90 = vec3(0.5);
    b.glass_through = 0.48 * vec3(0.9, 0.5, 0.2);
    b.glass_eta = eta;
    return b;
}
Drawn drawn_from(float alpha, float eta, vec3 wo, uint i)
{
    return sample_specular(mixed(alpha, eta), wo, sobol_point(i, 1u), sobol_point(i, 7u).x);
}
vec4 evaluated(float alpha, float eta, vec3 wo, vec3 wi)
{
    float pdf;
    vec3 f = evaluate_specular(mixed(alpha, eta), wo, wi, pdf);
    return vec4(f, pdf);
}
"""


def direction(degrees: float) -> np.ndarray:
    """Unit (3,) at that angle to the normal, at no special azimuth."""
    t = np.radians(degrees)
    return np.array([np.sin(t) * np.cos(0.7), np.sin(t) * np.sin(0.7), np.cos(t)], "f4")


def rows(n: int, **values) -> dict[str, np.ndarray]:
    """Each value n times."""
    return {name: np.repeat(np.array(value, "f4")[None], n, 0) for name, value in values.items()}


@pytest.mark.parametrize("alpha", [1e-4, 1e-2, 0.3, 1.0])
def test_the_normals_of_ggx_cover_the_surface_once(device, alpha):
    """int D h.z dw = 1. With s = x / (1 + x), x = (tan / alpha)^2 the integrand is constant: midpoints are exact."""
    s = (np.arange(2000) + 0.5) / 2000
    tan = alpha * np.sqrt(s / (1 - s))
    cos = 1 / np.sqrt(1 + tan**2)
    h = np.stack([tan * cos, 0 * s, cos], 1).astype("f4")
    found = evaluate(device, "float", "ggx_normals(h, a)", GGX, h=h, a=np.full(2000, alpha, "f4"))
    assert (found * np.pi * alpha**2 * cos**4 / (1 - s) ** 2).mean() == pytest.approx(1, rel=1e-4)


@pytest.mark.parametrize("eta", [1.5, 1 / 1.5, 2.4, 1.01])
def test_fresnel_is_what_the_equations_say(device, eta):
    """The mean of both polarisations; all of it beyond the critical angle."""
    c = np.linspace(0.01, 1, 100)
    sin_t = np.sqrt(1 - c**2) / eta
    t = np.sqrt(np.maximum(1 - sin_t**2, 0))
    s_polarised, p_polarised = ((c - eta * t) / (c + eta * t)) ** 2, ((t - eta * c) / (t + eta * c)) ** 2
    expected = np.where(sin_t >= 1, 1, (s_polarised + p_polarised) / 2)
    found = evaluate(device, "float", "f_dielectric(c, eta)", GGX, c=c.astype("f4"), eta=np.full(100, eta, "f4"))
    assert np.allclose(found, expected, atol=1e-4)


def test_the_mean_of_fresnel_is_its_integral(device):
    """The fit of the paper is good to 0.006 for the indices that there are, and 0.01 beyond total reflection."""
    eta = np.array([1.1, 1.3, 1.5, 2.0, 2.5, 1 / 1.3, 1 / 1.5, 1 / 2], "f4")
    c = ((np.arange(2000) + 0.5) / 2000).astype("f4")
    means = [(2 * c * evaluate(device, "float", "f_dielectric(c, eta)", GGX, c=c, eta=np.full(2000, e, "f4"))).mean()
             for e in eta]
    found = evaluate(device, "float", "f_dielectric_mean(eta)", GGX, eta=eta)
    assert np.allclose(found[:5], means[:5], atol=6e-3)
    assert np.allclose(found[5:], means[5:], atol=1e-2)


def test_an_edge_tint_tints_at_one_angle(device):
    """At normal incidence f0; at cos = 1/7 the tint times Schlick's value; white is Schlick's curve; the mean fits."""
    call = "f82(vec3(0.8), f82_dip(vec3(0.8), vec3(1.0, 0.5, 0.0)), c)"
    c = np.array([1.0, 1 / 7, 0.4], "f4")
    found = evaluate(device, "vec3", call, GGX, c=c)
    schlick = 0.8 + 0.2 * (1 - c) ** 5
    assert np.allclose(found[0], 0.8, atol=1e-5)
    assert np.allclose(found[1], schlick[1] * np.array([1, 0.5, 0]), atol=1e-5)
    assert found[2, 0] == pytest.approx(schlick[2], abs=1e-5)
    c = ((np.arange(4000) + 0.5) / 4000).astype("f4")
    means = (2 * c[:, None] * evaluate(device, "vec3", call, GGX, c=c)).mean(0)
    mean = evaluate(device, "vec3", "f82_mean(vec3(0.8), f82_dip(vec3(0.8), vec3(1.0, 0.5, 0.0)))", GGX, c=c[:1])[0]
    assert np.allclose(mean, means, atol=1e-4)


@pytest.mark.parametrize(("ior", "f0"), [(1.0, 0.0), (1.5, 0.04), (1 / 1.5, 0.04), (2.0, 1 / 9)])
def test_reflectance_of_an_index_of_refraction(device, ior, f0):
    found = evaluate(device, "vec2", "vec2(f0_of_ior(n), ior_of_f0(f0_of_ior(n)))", GGX, n=np.array([ior], "f4"))[0]
    assert found[0] == pytest.approx(f0, abs=1e-6)
    assert found[1] == pytest.approx(max(ior, 1 / ior), rel=1e-4)


@pytest.mark.parametrize("alpha", [0.01, 0.1, 0.5, 1.0])
@pytest.mark.parametrize("eta", [1.5, 1 / 1.5])
@pytest.mark.parametrize("degrees", [5, 60, 85])
def test_a_weight_is_the_value_over_the_density(device, alpha, eta, degrees):
    """Of what is drawn, wherever it goes. f4 loses digits where a narrow lobe is asked for its value."""
    n, wo = 2000, direction(degrees)
    i = np.arange(n, dtype="u4")
    inputs = {"i": i, **rows(n, alpha=alpha, eta=eta, wo=wo)}
    weight = evaluate(device, "vec3", "drawn_from(alpha, eta, wo, i).weight", BSDF, MIXED, **inputs)
    pdf = evaluate(device, "float", "drawn_from(alpha, eta, wo, i).pdf", BSDF, MIXED, **inputs)
    wi = evaluate(device, "vec3", "drawn_from(alpha, eta, wo, i).wi", BSDF, MIXED, **inputs)
    value = evaluate(device, "vec4", "evaluated(alpha, eta, wo, wi)", BSDF, MIXED, **{**inputs, "wi": wi})
    is_right = (weight > 0).any(1) & (np.abs(wi[:, 2]) > 1e-3)
    assert is_right.sum() > n / 3
    assert np.median(np.abs(value[is_right, 3] / pdf[is_right] - 1)) < 1e-3
    assert (np.abs(value[is_right, :3] / value[is_right, 3:] / weight[is_right] - 1).max(1) < 0.02).mean() > 0.98


@pytest.mark.parametrize("eta", [1.5, 1 / 1.5])
@pytest.mark.parametrize(("alpha", "degrees"), [(0.2, 20), (0.5, 60), (1.0, 40), (0.5, 80)])
def test_the_density_integrates_to_the_share_that_comes_out(device, alpha, eta, degrees):
    """Over both hemispheres: 1 less those that come out on the wrong side. 200 x 400 midpoints: 0.5 %."""
    wo = direction(degrees)
    z, phi = np.meshgrid((np.arange(400) + 0.5) / 200 - 1, (np.arange(400) + 0.5) / 400 * 2 * np.pi)
    wi = np.stack([np.sqrt(1 - z**2) * np.cos(phi), np.sqrt(1 - z**2) * np.sin(phi), z], -1).reshape(-1, 3).astype("f4")
    n = len(wi)
    pdf = evaluate(device, "vec4", "evaluated(alpha, eta, wo, wi)", BSDF, MIXED, wi=wi,
                   **rows(n, alpha=alpha, eta=eta, wo=wo))[:, 3]
    n = 8192
    weight = evaluate(device, "vec3", "drawn_from(alpha, eta, wo, i).weight", BSDF, MIXED,
                      i=np.arange(n, dtype="u4"), **rows(n, alpha=alpha, eta=eta, wo=wo))
    assert pdf.mean() * 4 * np.pi == pytest.approx((weight > 0).any(1).mean(), rel=0.01)


def test_reflection_is_reciprocal(device):
    rng = np.random.default_rng(1)
    a, b = rng.normal(size=(2, 4000, 3)).astype("f4")
    for d in (a, b):
        d /= np.linalg.norm(d, axis=1, keepdims=True)
        d[:, 2] = np.abs(d[:, 2])
    inputs = rows(4000, alpha=0.3, eta=1.5)
    there = evaluate(device, "vec4", "evaluated(alpha, eta, a, b)", BSDF, MIXED, a=a, b=b, **inputs)
    back = evaluate(device, "vec4", "evaluated(alpha, eta, b, a)", BSDF, MIXED, a=a, b=b, **inputs)
    assert np.isfinite(there).all() and there.min() >= 0
    assert np.allclose(there[:, :3] / b[:, 2:], back[:, :3] / a[:, 2:], rtol=1e-3)


@pytest.mark.parametrize(("eta", "degrees"), [(1.5, 30), (1.5, 80), (1 / 1.5, 30)])
def test_a_smooth_pane_bends_light_as_snell_says(device, eta, degrees):
    n, wo = 64, direction(degrees)
    inputs = {"i": np.arange(n, dtype="u4"), **rows(n, alpha=0.0, eta=eta, wo=wo)}
    wi = evaluate(device, "vec3", "drawn_from(alpha, eta, wo, i).wi", BSDF, MIXED, **inputs)
    through = wi[wi[:, 2] < 0]
    assert 10 < len(through) < n
    assert np.allclose(wi[wi[:, 2] > 0], wo * (-1, -1, 1), atol=1e-6)
    assert np.allclose(through[:, :2] * eta, -wo[:2], atol=1e-5)


def test_nothing_passes_beyond_the_critical_angle(device):
    n = 64
    wi = evaluate(device, "vec3", "drawn_from(alpha, eta, wo, i).wi", BSDF, MIXED, i=np.arange(n, dtype="u4"),
                  **rows(n, alpha=0.0, eta=1 / 1.5, wo=direction(60)))
    assert (wi[:, 2] > 0).all()


def test_glass_of_index_one_is_not_there(device):
    n, wo = 256, direction(50)
    inputs = {"i": np.arange(n, dtype="u4"), **rows(n, alpha=0.5, eta=1.0, wo=wo)}
    wi = evaluate(device, "vec3", "drawn_from(alpha, eta, wo, i).wi", BSDF, MIXED, **inputs)
    pdf = evaluate(device, "float", "drawn_from(alpha, eta, wo, i).pdf", BSDF, MIXED, **inputs)
    weight = evaluate(device, "vec3", "drawn_from(alpha, eta, wo, i).weight", BSDF, MIXED, **inputs)
    through = (wi[:, 2] < 0) & (weight > 0).any(1)
    assert through.mean() > 0.3
    assert np.allclose(wi[through], -wo, atol=1e-6) and (pdf[through] > 1e29).all()
