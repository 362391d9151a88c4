// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what each side of each surfel sees: its rays are traced once, and all bounces go along these links. They are the
//             same in every sweep, so that sweeps converge.
// Formula:    E_still = pi / N sum w L(w_i) of what the world sends, w_i distributed as cos; w is the weight of what
//             cache/direct draws as well [Veach95]
// In:         Surfels, world, triangles
// Out:        Links: the side that each ray hits, or NOTHING; LinkHits: the triangle and where on it, if anything shines;
//             Found: E_still
// Invocation: one in SPLIT rays of one side of one surfel

#include "bind/sky.glsl"
#include "bind/trace.glsl"
#include "bind/vertices.glsl"
#include "cache/side.glsl"

const uint SPLIT = 4u;            // invocations a side: few sides keep a large device busy too

layout(std430) buffer Found { vec4 found_light[]; };  // of each side
layout(std430) writeonly buffer Links { uint links[]; };  // u_n_rays a side: the first of all sides, the second of all ...
layout(std430) writeonly buffer LinkHits { uvec4 link_hits[]; };  // likewise: instance, triangle, barycentrics

uniform uint u_first;
uniform uint u_end;
uniform int u_n_rays;      // of each side, in all rounds
uniform int u_n_points;    // of cache/direct
uniform uint u_first_ray;  // of this round
uniform uint u_end_ray;
uniform bool u_keeps_hits;

shared vec3 found[GROUP];

// Follow every SPLIT-th ray of a side and return the irradiance that the world sends along them.
vec3 follow(uint side, uint part)
{
    Surface s = surface_of_side(side);
    vec3 E = vec3(0.0);
    mat3 frame = frame_of(s.normal);
    for (uint k = u_first_ray + part; k < u_end_ray; k += SPLIT) {
        vec3 local = cosine_direction(sobol_point(k, hash(side))), d = frame * local;
        Crossing c;
        bool is_hit = trace_closest(s.position, d, INFINITE, hash(side) + k, c);
        links[k * u_n_sides + side] = is_hit ? cache_side(s.position + c.t * d, normal_of(c.instance, c.triangle), d) : NOTHING;
        if (u_keeps_hits)
            link_hits[k * u_n_sides + side] = uvec4(c.instance, c.triangle, floatBitsToUint(c.bary));
        if (!is_hit)
            E += PI / float(u_n_rays) * world_radiance(d, 0.0) * world_weight(d, float(u_n_rays) / float(u_n_points) * local.z / PI);
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
