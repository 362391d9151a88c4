// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: a material of the table as Bsdf, layered and compensated as Cycles does for the Principled BSDF.

#include "bind/layers.glsl"
#include "bind/materials.glsl"

float coat_f0(Material m)
{
    return 2.0 * max(m.specular_level, 0.0) * f0_of_ior(m.ior);
}

// NoV: cosine of wo; is_back: whether wo lies behind the surface, inside of what it encloses.
Bsdf principled(Material m, Shading shading, float NoV, bool is_back)
{
    vec3 color = clamp(shading.base_color, 0.0, 1.0);
    float metallic = clamp(shading.metallic, 0.0, 1.0), rest = 1.0 - metallic, through = 1.0;
    float roughness = clamp(shading.roughness, 0.0, 1.0), ior = max(m.ior, 1e-5), f0 = coat_f0(m);
    Bsdf b = no_lobes(vec2(roughness * roughness));
    if (metallic > 0.0)
        add_metal(b, vec3(metallic), color, vec3(1.0), f82_dip(color, min(m.specular_tint, 1.0)), NoV, true);
    if (m.transmission > 0.0 && rest > 0.0)
        add_glass(b, vec3(rest * min(m.transmission, 1.0)), ior, clamp(f0_of_ior(ior) * m.specular_tint, 0.0, 1.0), vec3(1.0),
                  sqrt(color), NoV, is_back, true);
    rest *= 1.0 - clamp(m.transmission, 0.0, 1.0);
    if (f0 != 0.0 && rest != 0.0) {
        float eta = ior_of_f0(f0);
        through = add_coat(b, vec3(rest), m.ior < 1.0 ? 1.0 / eta : eta, clamp(f0 * m.specular_tint, 0.0, 1.0), NoV, true);
    }
    b.diffuse = max(shading.base_color, 0.0) * (rest * through);
    return b;
}

// Share of light from everywhere that comes back to everywhere, through all layers: what light that was spread sees of a
// surface. A metal is as white as its mean reflectance. Glass is dark, as in Cycles without caustics.
vec3 mean_albedo(Material m, Shading shading)
{
    vec3 color = clamp(shading.base_color, 0.0, 1.0), coat = vec3(0.0);
    float roughness = clamp(shading.roughness, 0.0, 1.0), metallic = clamp(shading.metallic, 0.0, 1.0), f0 = coat_f0(m);
    if (f0 > 0.0)
        coat = coat_mean(ior_of_f0(f0), clamp(f0 * m.specular_tint, 0.0, 1.0), roughness, true);
    return metallic * metal_mean(color, f82_dip(color, min(m.specular_tint, 1.0)), vec3(1.0), roughness, true)
         + (1.0 - metallic) * (1.0 - clamp(m.transmission, 0.0, 1.0)) * (coat + below(coat) * color);
}
