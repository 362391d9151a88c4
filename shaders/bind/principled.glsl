// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: a material as Bsdf, layered and compensated as Cycles does for the Principled BSDF.

#include "bind/albedo.glsl"
#include "bind/materials.glsl"
#include "lib/bsdf.glsl"

// How much brighter light between facets makes a layer that sends back E of white light after one scattering, E_mean over
// all directions: what is missing goes on to other facets, which reflect f_mean of it [Kulla17] [Turquin19].
vec3 with_bounces(float E, float E_mean, vec3 f_mean)
{
    return 1.0 + f_mean * E_mean / (1.0 - f_mean * (1.0 - E_mean)) * ((1.0 - E) / E);
}

void add_metal(inout Bsdf b, float weight, vec3 color, vec3 tint, vec4 table)
{
    b.metal_f0 = color;
    b.metal_dip = f82_dip(color, min(tint, 1.0));
    b.metal = weight * with_bounces(table.x, table.z, f82_mean(b.metal_f0, b.metal_dip));
    b.glossy += b.metal * max(b.metal_f0 * (table.x - table.y) + table.y - b.metal_dip * table.w, 0.0);
}

// Light loses the root of the colour at each of the two interfaces that it passes.
void add_glass(inout Bsdf b, float weight, Material m, vec3 color, float NoV, bool is_back)
{
    float ior = max(m.ior, 1e-5), roughness = sqrt(b.alpha);
    bool from_inside = is_back == (ior >= 1.0);  // on the side of the higher index
    b.glass_eta = is_back ? 1.0 / ior : ior;
    b.glass_f0 = clamp(f0_of_ior(ior) * m.specular_tint, 0.0, 1.0);
    b.glass_tint = sqrt(color);
    vec4 table = dielectric_albedo(roughness, NoV, max(ior, 1.0 / ior)), means = dielectric_mean(roughness, max(ior, 1.0 / ior));
    b.glass = weight * (from_inside ? with_bounces(table.w, means.y, b.glass_tint) : with_bounces(table.z, means.x, b.glass_tint));
    vec3 f = f_from(b.glass_f0, f_dielectric(NoV, b.glass_eta), b.glass_eta);
    b.glossy += weight * f;
    b.transmission = weight * (1.0 - f) * b.glass_tint;
}

// A dielectric layer; gives the part of the light that it lets through to what lies below, the same for all colours.
float add_coat(inout Bsdf b, float weight, Material m, float NoV)
{
    float f0 = 2.0 * max(m.specular_level, 0.0) * f0_of_ior(m.ior), roughness = sqrt(b.alpha);
    if (f0 == 0.0 || weight == 0.0)
        return weight;
    float ior = ior_of_f0(f0);
    b.coat_eta = m.ior < 1.0 ? 1.0 / ior : ior;
    b.coat_f0 = clamp(f0 * m.specular_tint, 0.0, 1.0);
    vec4 table = dielectric_albedo(roughness, NoV, ior);
    vec3 bounces = with_bounces(table.x, dielectric_mean(roughness, ior).z,
                                f_from(b.coat_f0, f_dielectric_mean(b.coat_eta), b.coat_eta));
    vec3 albedo = bounces * (b.coat_f0 * (table.x - table.y) + table.y);
    b.coat = weight * bounces;
    b.glossy += weight * albedo;
    return weight * clamp(1.0 - max(albedo.r, max(albedo.g, albedo.b)), 0.0, 1.0);
}

// NoV: cosine of wo; is_back: whether wo lies behind the surface, inside of what it encloses.
Bsdf principled(Material m, Shading shading, float NoV, bool is_back)
{
    vec3 none = vec3(0.0), color = clamp(shading.base_color, 0.0, 1.0);
    float metallic = clamp(shading.metallic, 0.0, 1.0), rest = 1.0 - metallic;
    float roughness = clamp(shading.roughness, 0.0, 1.0);
    Bsdf b = Bsdf(none, roughness * roughness, none, none, none, none, none, 1.0, none, none, none, 1.0, none, none);
    if (metallic > 0.0)
        add_metal(b, metallic, color, m.specular_tint, metal_albedo(roughness, NoV));
    if (m.transmission > 0.0 && rest > 0.0)
        add_glass(b, rest * min(m.transmission, 1.0), m, color, NoV, is_back);
    rest *= 1.0 - clamp(m.transmission, 0.0, 1.0);
    b.diffuse = max(shading.base_color, 0.0) * add_coat(b, rest, m, NoV);
    return b;
}

// Share of light from everywhere that comes back to everywhere, through all layers: what light that was spread sees of a
// surface. A metal is as white as its mean reflectance. Glass is dark, as in Cycles without caustics.
vec3 mean_albedo(Material m, Shading shading)
{
    vec3 color = clamp(shading.base_color, 0.0, 1.0);
    float roughness = clamp(shading.roughness, 0.0, 1.0), metallic = clamp(shading.metallic, 0.0, 1.0);
    float f0 = 2.0 * max(m.specular_level, 0.0) * f0_of_ior(m.ior), ior = ior_of_f0(f0);
    vec4 means = dielectric_mean(roughness, ior);
    vec3 metal = f82_mean(color, f82_dip(color, min(m.specular_tint, 1.0)));
    vec3 coat_f0 = clamp(f0 * m.specular_tint, 0.0, 1.0), coat = vec3(0.0);
    if (f0 > 0.0)
        coat = (coat_f0 * (means.z - means.w) + means.w) * with_bounces(means.z, means.z, f_from(coat_f0, f_dielectric_mean(ior), ior));
    float through = 1.0 - max(coat.r, max(coat.g, coat.b));
    return metallic * metal * means.z * with_bounces(means.z, means.z, metal)
         + (1.0 - metallic) * (1.0 - clamp(m.transmission, 0.0, 1.0)) * (coat + through * color);
}
