// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what each side of each surfel sees: its rays are traced once, and all bounces go along these links. They are the
//             same in every sweep, so that sweeps converge.
// In:         Surfels, triangles
// Out:        Links: the side that each ray hits, NOTHING or MISSED; LinkHits: the triangle and where on it, if anything
//             shines
// Invocation: one in SPLIT rays of one side of one surfel

#include "bind/trace.glsl"
#include "bind/vertices.glsl"
#include "cache/side.glsl"

const uint SPLIT = 4u;            // invocations a side: few sides keep a large device busy too

layout(std430) writeonly buffer Links { uint links[]; };  // u_n_rays a side: the first of all sides, the second of all ...
layout(std430) writeonly buffer LinkHits { uvec4 link_hits[]; };  // likewise: instance, triangle, barycentrics

uniform uint u_first;
uniform uint u_end;
uniform uint u_first_ray;  // of this round
uniform uint u_end_ray;
uniform bool u_keeps_hits;

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x, side = index / SPLIT;
    if (index >= u_end)
        return;
    Surface s = surface_of_side(side);
    mat3 frame = frame_of(s.normal);
    for (uint k = u_first_ray + index % SPLIT; k < u_end_ray; k += SPLIT) {
        vec3 d = frame * cosine_direction(sobol_point(k, hash(side)));
        Crossing c;
        uint link = MISSED;
        if (trace_closest(s.position, d, INFINITE, hash(side) + k, c))
            link = cache_side(s.position + c.t * d, normal_of(c.instance, c.triangle), d);
        links[k * u_n_sides + side] = link;
        if (u_keeps_hits)
            link_hits[k * u_n_sides + side] = uvec4(c.instance, c.triangle, floatBitsToUint(c.bary));
    }
}
