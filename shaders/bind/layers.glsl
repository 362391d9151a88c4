// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: layers of microfacets, compensated for light that goes from facet to facet as Cycles does. weight: the part of all
// light that reaches a layer; has_bounces: whether what is missing after one scattering is put back.

#include "bind/albedo.glsl"
#include "lib/bsdf.glsl"

// How much brighter light between facets makes a layer that sends back E of white light after one scattering, E_mean over
// all directions: what is missing goes on to other facets, which reflect f_mean of it [Kulla17] [Turquin19].
vec3 with_bounces(float E, float E_mean, vec3 f_mean)
{
    return 1.0 + f_mean * E_mean / (1.0 - f_mean * (1.0 - E_mean)) * ((1.0 - E) / E);
}

float roughness_of(vec2 alpha)
{
    return sqrt(sqrt(alpha.x * alpha.y));
}

// A reflectance from f0 to f90 with a dip before that.
void add_metal(inout Bsdf b, vec3 weight, vec3 f0, vec3 f90, vec3 dip, float NoV, bool has_bounces)
{
    vec4 table = metal_albedo(roughness_of(b.alpha), NoV);
    if (has_bounces)
        weight *= with_bounces(table.x, table.z, clamp(mix(f0, f90, 1.0 / 21.0) - dip / 126.0, 0.0, 1.0));
    b.metal_f0 += weight * f0;
    b.metal_f90 += weight * f90;
    b.metal_dip += weight * dip;
    b.glossy += weight * max(f0 * (table.x - table.y) + f90 * table.y - dip * table.w, 0.0);
}

// The boundary of a body of index `ior`, from inside if is_back. f0, f90: reflectances, times `tint`; what does not go back
// passes, times `through`.
void add_glass(inout Bsdf b, vec3 weight, float ior, vec3 f0, vec3 tint, vec3 through, float NoV, bool is_back,
               bool has_bounces)
{
    float roughness = roughness_of(b.alpha);
    bool from_inside = is_back == (ior >= 1.0);  // on the side of the higher index
    b.glass_eta = is_back ? 1.0 / ior : ior;
    vec4 table = dielectric_albedo(roughness, NoV, max(ior, 1.0 / ior)), means = dielectric_mean(roughness, max(ior, 1.0 / ior));
    vec3 own = weight;
    if (has_bounces)
        own *= from_inside ? with_bounces(table.w, means.y, through) : with_bounces(table.z, means.x, through);
    b.glass_f0 += own * f0 * tint;
    b.glass_f90 += own * tint;
    b.glass_through += own * (1.0 - f0) * through;
    vec3 f = f_from(f0, f_dielectric(NoV, b.glass_eta), b.glass_eta);
    b.glossy += weight * f * tint;
    b.transmission += weight * (1.0 - f) * through;
}

// The part that a layer of that albedo lets through to what lies below, the same for all colours.
float below(vec3 albedo)
{
    return clamp(1.0 - max(albedo.r, max(albedo.g, albedo.b)), 0.0, 1.0);
}

// A dielectric layer of index eta whose reflectance begins at f0; gives the part that it lets through.
float add_coat(inout Bsdf b, vec3 weight, float eta, vec3 f0, float NoV, bool has_bounces)
{
    float roughness = roughness_of(b.alpha), ior = max(eta, 1.0 / eta);
    vec4 table = dielectric_albedo(roughness, NoV, ior);
    vec3 bounces = vec3(1.0);
    if (has_bounces)
        bounces = with_bounces(table.x, dielectric_mean(roughness, ior).z, f_from(f0, f_dielectric_mean(eta), eta));
    vec3 albedo = bounces * (f0 * (table.x - table.y) + table.y);
    b.coat_eta = eta;
    b.coat_f0 += weight * bounces * f0;
    b.coat_f90 += weight * bounces;
    b.glossy += weight * albedo;
    return below(albedo);
}

// Shares of light from everywhere that come back to everywhere: of such a metal,
vec3 metal_mean(vec3 f0, vec3 dip, vec3 f90, float roughness, bool has_bounces)
{
    float E = dielectric_mean(roughness, 1.0).z;
    vec3 mean = clamp(mix(f0, f90, 1.0 / 21.0) - dip / 126.0, 0.0, 1.0);
    return mean * E * (has_bounces ? with_bounces(E, E, mean) : vec3(1.0));
}

// and of such a coat.
vec3 coat_mean(float eta, vec3 f0, float roughness, bool has_bounces)
{
    vec4 means = dielectric_mean(roughness, max(eta, 1.0 / eta));
    vec3 once = f0 * (means.z - means.w) + means.w;
    return has_bounces ? once * with_bounces(means.z, means.z, f_from(f0, f_dielectric_mean(eta), eta)) : once;
}
