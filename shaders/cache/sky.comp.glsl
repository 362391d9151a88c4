// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what the world sends to each side of each surfel along those of its links that meet nothing.
// Formula:    E_still = pi / N sum w L(w_i), w_i distributed as cos; w is the weight of what cache/direct draws as well
//             [Veach95]
// In:         Surfels, Links, world
// Out:        Found
// Invocation: one side of one surfel

#include "bind/sky.glsl"
#include "cache/side.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer Found { vec4 found_light[]; };
layout(std430) readonly buffer Links { uint links[]; };

uniform uint u_first;
uniform uint u_end;
uniform int u_n_rays;    // of each side
uniform int u_n_points;  // of cache/direct

void main()
{
    uint side = u_first + gl_GlobalInvocationID.x;
    if (side >= u_end)
        return;
    mat3 frame = frame_of(surface_of_side(side).normal);
    vec3 E = vec3(0.0);
    for (uint k = 0u; k < uint(u_n_rays); k++) {
        if (links[k * u_n_sides + side] != MISSED)
            continue;
        vec3 local = cosine_direction(sobol_point(k, hash(side))), d = frame * local;
        E += world_radiance(d, 0.0) * world_weight(d, float(u_n_rays) / float(u_n_points) * local.z / PI);
    }
    found_light[side] = vec4(E * (PI / float(u_n_rays)), 0.0);
}
