// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what each side of each surfel sees: its rays are traced once, and all bounces go along these links. They are the
//             same in every sweep, so that sweeps converge.
// Formula:    E_still = pi / N sum w L(w_i) of what emissive surfaces and the world send, w_i distributed as cos; w is the
//             weight of what cache/direct draws as well [Veach95]
// In:         Surfels, world, triangles, lights
// Out:        Links: the side that each ray hits, or NOTHING; Found: E_still
// Invocation: one in SPLIT rays of one side of one surfel

#include "bind/lights.glsl"
#include "cache/side.glsl"

const int N_RAYS = 16;            // of each side, in all rounds
const int N_POINTS = 4;           // of cache/direct
const bool HAS_EMISSION = false;  // any material that sends out light
const uint SPLIT = 4u;            // invocations a side: few sides keep a large device busy too

layout(std430) buffer Found { vec4 found_light[]; };  // of each side
layout(std430) writeonly buffer Links { uint links[]; };  // N_RAYS a side: the first of all sides, the second of all ...

uniform uint u_first;
uniform uint u_end;
uniform uint u_first_ray;  // of this round
uniform uint u_end_ray;

// The side of the cache that a ray hits.
uint side_hit(vec3 o, vec3 d, Hit hit)
{
    uvec4 corners = triangles[hit.triangle];
    vec3 a = vertex_ws(hit.instance, corners.x);
    vec3 n = cross(vertex_ws(hit.instance, corners.y) - a, vertex_ws(hit.instance, corners.z) - a);
    return cache_side(o + hit.t * d, n, d);
}

// What a ray finds that no bounce changes; pdf: of all rays, over the number of points that cache/direct draws.
vec3 still_light(Surface s, vec3 d, bool is_hit, Hit hit, float pdf)
{
    if (!is_hit)
        return world_radiance(d, 0.0) * world_weight(s, d, pdf);
    if (!HAS_EMISSION)
        return vec3(0.0);
    vec2 uv = HAS_TEXTURES ? uv_at(hit.triangle, hit.bary) : vec2(0.0);
    vec3 L = emission_at(material_of(hit.instance, hit.triangle), uv, HAS_TEXTURES);
    return L == vec3(0.0) ? L : L * emitter_weight(s, d, hit, pdf);
}

shared vec3 found[GROUP];

// Follow every SPLIT-th ray of a side and return the irradiance that no bounce changes.
vec3 follow(uint side, uint part)
{
    Surface s = surface_of_side(side);
    vec3 E = vec3(0.0);
    mat3 frame = frame_of(s.normal);
    for (uint k = u_first_ray + part; k < u_end_ray; k += SPLIT) {
        vec3 local = cosine_direction(sobol_point(k, hash(side))), d = frame * local;
        Hit hit;
        bool is_hit = trace_closest(s.position, d, INFINITE, hash(side) + k, hit);
        links[k * u_n_sides + side] = is_hit ? side_hit(s.position, d, hit) : NOTHING;
        E += PI / float(N_RAYS) * still_light(s, d, is_hit, hit, float(N_RAYS) / float(N_POINTS) * local.z / PI);
    }
    return E;
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x, lane = gl_LocalInvocationIndex;
    uint side = index / SPLIT, part = index % SPLIT;
    found[lane] = index < u_end ? follow(side, part) : vec3(0.0);
    barrier();
    if (index >= u_end || part != 0u)
        return;
    vec3 E = u_first_ray > 0u ? found_light[side].rgb : vec3(0.0);
    for (uint i = 0u; i < SPLIT; i++)
        E += found[lane + i];
    found_light[side] = vec4(E, 0.0);
}
