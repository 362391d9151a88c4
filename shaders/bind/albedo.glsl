// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: directional albedos of microfacet surfaces, from albedo/integrate: what they send back of uniform light, with one
// scattering at the facets. Columns go by roughness, rows by the square root of the cosine, linearly in between.

#include "lib/ggx.glsl"

uniform sampler2DArray u_albedo;

const int ALBEDO_N = 32;             // columns, rows
const int ALBEDO_IORS = 24;          // layers of dielectrics: E, E F', glass from outside, glass from inside
const int ALBEDO_METALS = 24;        // layer of metals: E, E F of Schlick for f0 = 0, mean of E, the dip of f82 for b = 1
const int ALBEDO_MEANS = 25;         // layer of means over cos, a row an ior: glass from outside and inside, E, E F'

// F' goes from 0 at normal incidence to 1, as F goes from f0 to 1. Layer i is of this index of refraction.
float albedo_ior(float i)
{
    float z = i / float(ALBEDO_IORS - 1);
    return ior_of_f0(z * z * z * z);
}

float albedo_layer(float ior)
{
    return sqrt(abs(ior - 1.0) / (ior + 1.0)) * float(ALBEDO_IORS - 1);
}

vec4 albedo_texel(float roughness, float row, int layer)
{
    vec2 at = clamp(vec2(roughness, row), 0.0, 1.0) * float(ALBEDO_N - 1) + 0.5;
    return textureLod(u_albedo, vec3(at / float(ALBEDO_N), float(layer)), 0.0);
}

vec4 dielectric_albedo(float roughness, float NoV, float ior)
{
    float layer = albedo_layer(ior), row = sqrt(max(NoV, 0.0));
    int i = min(int(layer), ALBEDO_IORS - 2);
    return mix(albedo_texel(roughness, row, i), albedo_texel(roughness, row, i + 1), layer - float(i));
}

vec4 dielectric_mean(float roughness, float ior)
{
    return albedo_texel(roughness, albedo_layer(ior) / float(ALBEDO_IORS - 1), ALBEDO_MEANS);
}

vec4 metal_albedo(float roughness, float NoV)
{
    return albedo_texel(roughness, sqrt(max(NoV, 0.0)), ALBEDO_METALS);
}

// Reflectance under uniform light, f0 * x + y, of a microfacet surface with Schlick's Fresnel [Karis13].
vec2 environment_brdf(float roughness, float NoV)
{
    vec2 e = metal_albedo(roughness, NoV).xy;
    return vec2(e.x - e.y, e.y);
}
