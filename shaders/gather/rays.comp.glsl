// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that arrives at each pixel, by rays with exact hits: lamps with traced shadows, diffuse light by
//             cosine-distributed rays, reflections by visible GGX normals; all later bounces from the light cache.
// Formula:    E = pi / N sum L(w_i), w_i distributed as cos; specular f cos / pdf = F G2 / G1 [Heitz18]
// In:         G-buffer, scene, BVH, lamps, light cache, world
// Out:        u_irradiance_direct, u_irradiance_indirect [W m^-2]; u_specular [W m^-2 sr^-1], what leaves towards the eye
// Invocation: one pixel

#include "bind/gbuffer.glsl"
#include "bind/environment.glsl"
#include "bind/cache.glsl"
#include "bind/lamps.glsl"
#include "lib/brdf.glsl"

const bool HAS_TEXTURES = false;
const bool HAS_INDIRECT = true;   // anything that a ray could find
const bool HAS_SPECULAR = true;   // any material that reflects
const int N_RAYS = 4;             // diffuse rays
const int MAX_MIRRORS = 4;        // reflections of reflections

layout(local_size_x = 64) in;

layout(rgba32f) uniform writeonly image2D u_irradiance_direct;
layout(rgba32f) uniform writeonly image2D u_irradiance_indirect;
layout(rgba32f) uniform writeonly image2D u_specular;

uniform uint u_first;
uniform uint u_end;
uniform uint u_sample;
uniform uint u_seed;

// A surface met by a ray, its normals turned against the ray.
struct Met {
    Surface surface;
    Shading shading;
    uint side;  // of the light cache
};

Met met_at(Hit hit, vec3 d)
{
    Met met;
    met.surface = seen_surface(hit.instance, hit.triangle, hit.bary, -d, HAS_TEXTURES);
    met.side = cache_side(met.surface.position, met.surface.normal_geometric, d);
    met.shading = shading_at(met.surface.material, met.surface.uv, HAS_TEXTURES);
    return met;
}

// Light that leaves a met surface against a diffuse ray: lamps exactly, all else from the cache. A metal counts as white
// as its colour: what it mirrors is taken as its share of what arrives from everywhere.
vec3 leaving(Met met, uint seed)
{
    vec3 E = lamps_irradiance(met.surface, u_sample, seed);
    if (met.side != NOTHING)
        E += cache[cache_entry(INDIRECT, met.side)].rgb;
    vec3 rho = met.shading.base_color * (1.0 - materials[met.surface.material].transmission);
    return met.shading.emission + rho / PI * E;
}

vec3 diffuse_light(Surface s, uint seed)
{
    mat3 frame = frame_of(s.normal);
    vec3 E = vec3(0.0);
    for (int k = 0; k < N_RAYS; k++) {
        vec3 d = frame * cosine_direction(r2_point(u_sample * uint(N_RAYS) + uint(k), seed));
        if (dot(d, s.normal_geometric) <= 0.0)
            continue;
        Hit hit;
        uint ray_seed = hash(seed + uint(k) + 1u);
        if (trace_closest(offset_origin(s.position, s.normal_geometric, d), d, INFINITE, hash(ray_seed + u_sample), hit))
            E += leaving(met_at(hit, d), ray_seed);
        else
            E += world_radiance(d, 0.0);
    }
    return E * (PI / float(N_RAYS));
}

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
    for (int i = 0; i < N_LIGHTS; i++) {
        LightSample light = visible_light(i, s, r2_point(u_sample, seed + uint(i)), hash(seed + u_sample));
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

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    vec3 E_direct = vec3(0.0), E_indirect = vec3(0.0), specular = vec3(0.0);
    Seen seen = seen_at(pixel, HAS_TEXTURES);
    if (seen.hit) {
        Surface s = seen.surface;
        uint seed = hash(uint(pixel.x) + hash(uint(pixel.y) + u_seed));
        E_direct = lamps_irradiance(s, u_sample, seed);
        if (HAS_INDIRECT)
            E_indirect = diffuse_light(s, seed);
        if (HAS_SPECULAR)
            specular = reflected_light(s, seen.shading, seen.wo, hash(seed + 3u));
    }
    imageStore(u_irradiance_direct, pixel, vec4(E_direct, 0.0));
    imageStore(u_irradiance_indirect, pixel, vec4(E_indirect, 0.0));
    imageStore(u_specular, pixel, vec4(specular, 0.0));
}
