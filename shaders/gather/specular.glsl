// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the light that a surface mirrors towards the eye, followed from mirror to mirror.

#include "bind/environment.glsl"
#include "gather/met.glsl"
#include "lib/brdf.glsl"

const int MAX_MIRRORS = 4;  // reflections of reflections

vec3 reflectance_of(uint material, Shading shading)
{
    Material m = materials[material];
    return mix(f0_of_ior(m.ior) * 2.0 * m.specular_level * m.specular_tint, shading.base_color, shading.metallic);
}

// Lamps in a microfacet surface, without what a reflection ray would find.
vec3 specular_lamps(Surface s, vec3 wo, vec3 f0, float alpha, uint seed)
{
    vec3 L = vec3(0.0);
    float NoV = dot(s.normal, wo);
    for (int k = 0; k < n_draws(); k++) {
        LightDraw light = draw_light(k, s, u_sample, seed);
        float NoL = dot(s.normal, light.wi);
        if (NoL > 0.0 && light.E_perp != vec3(0.0)) {
            vec3 h = normalize(light.wi + wo);
            L += NoL * light.E_perp * smith_brdf(f0, alpha, dot(s.normal, h), NoV, NoL, dot(wo, h));
        }
    }
    return L;
}

// Reflected light by one ray, followed from mirror to mirror while the surfaces stay smooth.
vec3 reflected_light(Surface s, Shading shading, vec3 wo, uint seed)
{
    vec3 beta = vec3(1.0), L = vec3(0.0);
    for (int depth = 0; depth < MAX_MIRRORS; depth++) {
        vec3 f0 = reflectance_of(s.material, shading);
        float alpha = max(shading.roughness * shading.roughness, 1e-4);
        if (f0 == vec3(0.0))
            break;
        L += beta * specular_lamps(s, wo, f0, alpha, seed);
        vec3 weight, d = sample_reflection(s.normal, wo, f0, alpha, r2_point(u_sample, hash(seed + 7u)), weight);
        if (dot(d, s.normal_geometric) <= 0.0)
            break;
        beta *= weight;
        Hit hit;
        seed = hash(seed);
        if (!trace_closest(offset_origin(s.position, s.normal_geometric, d), d, INFINITE, hash(seed + u_sample), hit))
            return L + beta * world_radiance(d, 0.0);
        Met met = met_at(hit, d);
        s = met.surface, shading = met.shading, wo = -d;
        L += beta * (shading.metallic < 1.0 || depth + 1 == MAX_MIRRORS ? leaving(met, seed) * (1.0 - shading.metallic)
                                                                        : shading.emission);
    }
    return L;
}
