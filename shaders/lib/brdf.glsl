// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the microfacet terms of the thesis: GGX, Schlick, Cook-Torrance. All cosines are positive.

#include "lib/ggx.glsl"

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

// Reflectance at normal incidence under the Principled BSDF's "Specular IOR Level", which scales it; no more than all light is reflected.
float dielectric_f0(float ior, float specular_level)
{
    return min(2.0 * specular_level * f0_of_ior(ior), 1.0);
}
