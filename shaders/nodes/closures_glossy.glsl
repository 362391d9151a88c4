// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: closures of microfacets alone. has_bounces: the distribution that keeps the light which goes from facet to facet.

#include "nodes/closures.glsl"

// alpha along and across for a roughness; the nodes Metallic and Principled stretch it so.
vec2 stretched_alpha(float roughness, float anisotropy)
{
    float r = clamp(roughness, 0.0, 1.0), aspect = sqrt(1.0 - 0.9 * clamp(anisotropy, 0.0, 1.0));
    return min(r * r * vec2(1.0 / aspect, aspect), 1.0);
}

// Lobes whose grain runs along `tangent`, turned round the normal by `rotation` turns.
Bsdf grained_lobes(vec2 alpha, vec3 normal, vec3 tangent, float rotation)
{
    Bsdf b = no_lobes(alpha);
    mat3 frame = frame_of(normal);
    vec2 t = vec2(dot(tangent, frame[0]), dot(tangent, frame[1]));
    b.turn = alpha.x == alpha.y || dot(t, t) < 1e-20 ? 0.0 : mod(atan(t.y, t.x) + 2.0 * PI * rotation, 2.0 * PI);
    return b;
}

void closure_glossy(inout Closures c, float weight, Geo g, vec3 color, float roughness, float anisotropy, float rotation, vec3 normal, vec3 tangent, bool has_bounces)
{
    vec3 n = seen_normal(g, normal), tint = max(color, 0.0);
    float a = clamp(anisotropy, -0.99, 0.99), r = clamp(roughness, 0.0, 1.0);
    vec2 alpha = r * r * (a < 0.0 ? vec2(1.0 / (1.0 + a), 1.0 + a) : vec2(1.0 - a, 1.0 / (1.0 - a)));
    Bsdf b = grained_lobes(min(alpha, 1.0), n, tangent, rotation);
    add_metal(b, vec3(weight), tint, tint, vec3(0.0), dot(n, g.wo), has_bounces);
    c.mean += weight * metal_mean(tint, vec3(0.0), tint, r, has_bounces);
    add_lobes(c, b, n);
}

void closure_metallic(inout Closures c, float weight, Geo g, vec3 color, vec3 edge_tint, float roughness, float anisotropy, float rotation, vec3 normal, vec3 tangent, bool has_bounces)
{
    vec3 n = seen_normal(g, normal), f0 = clamp(color, 0.0, 1.0), dip = f82_dip(f0, clamp(edge_tint, 0.0, 1.0));
    Bsdf b = grained_lobes(stretched_alpha(roughness, anisotropy), n, tangent, rotation);
    add_metal(b, vec3(weight), f0, vec3(1.0), dip, dot(n, g.wo), has_bounces);
    c.mean += weight * metal_mean(f0, dip, vec3(1.0), clamp(roughness, 0.0, 1.0), has_bounces);
    add_lobes(c, b, n);
}

// Reflectance of a metal of complex index n + i k at an angle of that cosine, mean of both polarisations.
vec3 conductor(vec3 n, vec3 k, float cosine)
{
    float c2 = cosine * cosine, s2 = 1.0 - c2;
    vec3 t = n * n - k * k - s2, both = sqrt(t * t + 4.0 * n * n * k * k), a = sqrt(max(0.5 * (both + t), 0.0));
    vec3 across = (both + c2 - 2.0 * a * cosine) / max(both + c2 + 2.0 * a * cosine, 1e-12);
    vec3 p = c2 * both + s2 * s2, q = 2.0 * a * (cosine * s2);
    return 0.5 * across * (1.0 + (p - q) / max(p + q, 1e-12));
}

// By the curve that has the metal's reflectances at normal incidence and at cos = 1/7 [Kutz21].
void closure_conductor(inout Closures c, float weight, Geo g, vec3 ior, vec3 extinction, float roughness, float anisotropy, float rotation, vec3 normal, vec3 tangent, bool has_bounces)
{
    vec3 n = seen_normal(g, normal), f0 = conductor(max(ior, 0.0), max(extinction, 0.0), 1.0);
    vec3 edge = conductor(max(ior, 0.0), max(extinction, 0.0), 1.0 / 7.0) / max(mix(f0, vec3(1.0), pow(6.0 / 7.0, 5.0)), 1e-6);
    vec3 dip = f82_dip(f0, edge);
    Bsdf b = grained_lobes(stretched_alpha(roughness, anisotropy), n, tangent, rotation);
    add_metal(b, vec3(weight), f0, vec3(1.0), dip, dot(n, g.wo), has_bounces);
    c.mean += weight * metal_mean(f0, dip, vec3(1.0), clamp(roughness, 0.0, 1.0), has_bounces);
    add_lobes(c, b, n);
}

// Glass is dark to light that was spread, as in Cycles without caustics.
void closure_glass(inout Closures c, float weight, Geo g, vec3 color, float roughness, float ior, vec3 normal, bool has_bounces)
{
    vec3 n = seen_normal(g, normal), tint = max(color, 0.0);
    float r = clamp(roughness, 0.0, 1.0), index = max(ior, 1e-5);
    Bsdf b = no_lobes(vec2(r * r));
    add_glass(b, vec3(weight), index, vec3(f0_of_ior(index)), tint, tint, dot(n, g.wo), g.is_back, has_bounces);
    add_lobes(c, b, n);
}

// All that reaches the facets passes, short of total reflection, where nothing is left.
void closure_refraction(inout Closures c, float weight, Geo g, vec3 color, float roughness, float ior, vec3 normal)
{
    vec3 n = seen_normal(g, normal);
    float r = clamp(roughness, 0.0, 1.0), index = max(ior, 1e-5);
    Bsdf b = no_lobes(vec2(r * r));
    b.glass_eta = g.is_back ? 1.0 / index : index;
    b.is_level = true;
    b.glass_through = weight * max(color, 0.0);
    b.transmission = f_dielectric(dot(n, g.wo), b.glass_eta) < 1.0 ? b.glass_through : vec3(0.0);
    add_lobes(c, b, n);
}
