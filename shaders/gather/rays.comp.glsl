// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that arrives at each pixel, by rays with exact hits: lamps with traced shadows, diffuse light by
//             cosine-distributed rays, reflections by visible GGX normals; all later bounces from the light cache.
// Formula:    E = pi / N sum L(w_i), w_i distributed as cos; specular f cos / pdf = F G2 / G1 [Heitz18]
// In:         G-buffer, scene, BVH, lamps, light cache, world
// Out:        u_irradiance_direct, u_irradiance_indirect [W m^-2]; u_specular [W m^-2 sr^-1], what leaves towards the eye
// Invocation: one pixel

#include "bind/gbuffer.glsl"
#include "gather/specular.glsl"

const bool HAS_INDIRECT = true;   // anything that a ray could find
const bool HAS_SPECULAR = true;   // any material that reflects
const int N_RAYS = 4;             // diffuse rays

layout(local_size_x = 64) in;

layout(rgba32f) uniform writeonly image2D u_irradiance_direct;
layout(rgba32f) uniform writeonly image2D u_irradiance_indirect;
layout(rgba32f) uniform writeonly image2D u_specular;

uniform uint u_first;
uniform uint u_end;
uniform uint u_seed;

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
