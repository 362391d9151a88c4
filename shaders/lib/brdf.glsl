// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the microfacet terms of the thesis: GGX, Schlick, Cook-Torrance. All cosines are positive.

#include "lib/math.glsl"

// Distribution of microfacet normals [Walter07], alpha = roughness^2.
float d_ggx(float NoH, float alpha)
{
    float a2 = alpha * alpha;
    float k = NoH * NoH * (a2 - 1.0) + 1.0;
    return a2 / (PI * k * k);
}

// Reflectance at the angle whose cosine is VoH [Schlick94].
vec3 f_schlick(vec3 f0, float VoH)
{
    float m = clamp(1.0 - VoH, 0.0, 1.0);
    return f0 + (1.0 - f0) * (m * m * m * m * m);
}

// Shadowing and masking of V-shaped grooves [CookTorrance82].
float g_cook_torrance(float NoH, float NoV, float NoL, float VoH)
{
    return min(1.0, 2.0 * NoH * min(NoV, NoL) / max(VoH, 1e-6));
}

// f = D F G / (4 NoL NoV) [sr^-1]
vec3 microfacet_brdf(vec3 f0, float alpha, float NoH, float NoV, float NoL, float VoH)
{
    return d_ggx(NoH, alpha) * f_schlick(f0, VoH) * (g_cook_torrance(NoH, NoV, NoL, VoH) / (4.0 * NoL * NoV));
}

// Smith's shadowing of one direction under GGX [Walter07].
float g1_smith(float NoX, float alpha)
{
    float a2 = alpha * alpha;
    return 2.0 * NoX / (NoX + sqrt(a2 + (1.0 - a2) * NoX * NoX));
}

// Height-correlated Smith over GGX, f = D F G2 / (4 NoL NoV) [Heitz14].
vec3 smith_brdf(vec3 f0, float alpha, float NoH, float NoV, float NoL, float VoH)
{
    float a2 = alpha * alpha;
    float v = NoL * sqrt(a2 + (1.0 - a2) * NoV * NoV), l = NoV * sqrt(a2 + (1.0 - a2) * NoL * NoL);
    return d_ggx(NoH, alpha) * f_schlick(f0, VoH) * (0.5 / max(v + l, 1e-9));
}

// A reflected direction by the normals that wo can see [Heitz18], and its weight f cos / pdf = F G2 / G1(wo).
vec3 sample_reflection(vec3 n, vec3 wo, vec3 f0, float alpha, vec2 u, out vec3 weight)
{
    mat3 frame = frame_of(n);
    vec3 v = wo * frame;
    vec3 stretched = normalize(vec3(alpha * v.xy, v.z));
    vec2 p = disk_point(u);
    float s = 0.5 * (1.0 + stretched.z);
    p.y = mix(sqrt(max(1.0 - p.x * p.x, 0.0)), p.y, s);
    vec3 t1 = dot(stretched.xy, stretched.xy) > 1e-12 ? normalize(vec3(-stretched.y, stretched.x, 0.0)) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(stretched, t1);
    vec3 h = p.x * t1 + p.y * t2 + sqrt(max(1.0 - dot(p, p), 0.0)) * stretched;
    h = normalize(vec3(alpha * h.xy, max(h.z, 1e-6)));
    vec3 d = reflect(-v, h);
    float NoV = max(v.z, 1e-6), NoL = max(d.z, 1e-6), a2 = alpha * alpha;
    float a = NoL * sqrt(a2 + (1.0 - a2) * NoV * NoV), b = NoV * sqrt(a2 + (1.0 - a2) * NoL * NoL);
    weight = f_schlick(f0, max(dot(v, h), 0.0)) * (2.0 * NoL * NoV / (a + b)) / g1_smith(NoV, alpha);
    return frame * d;
}

// Reflectance of a GGX surface under uniform light, f0 * x + y: a fit to the integral [Karis13], which leaves [0, 1] at
// its ends and is cut off there.
vec2 environment_brdf(float roughness, float NoV)
{
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * NoV)) * r.x + r.y;
    return clamp(vec2(-1.04, 1.04) * a + r.zw, 0.0, 1.0);
}

// Reflectance at normal incidence of a dielectric of that index of refraction.
float f0_of_ior(float ior)
{
    float r = (ior - 1.0) / (ior + 1.0);
    return r * r;
}

// The same under the Principled BSDF's "Specular IOR Level", which scales it; no more than all light is reflected.
float dielectric_f0(float ior, float specular_level)
{
    return min(2.0 * specular_level * f0_of_ior(ior), 1.0);
}
