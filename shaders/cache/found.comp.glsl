// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what emissive surfaces send along the rays of cache/link: their materials know it, and programs that trace know
//             no materials.
// Formula:    E_still += pi / N sum w L(w_i); w is the weight of what cache/direct draws as well [Veach95]
// In:         Surfels, LinkHits, triangles, materials, emissive triangles
// Out:        Found
// Invocation: one side of one surfel

#include "bind/emitters.glsl"
#include "bind/emission.glsl"
#include "cache/side.glsl"

layout(local_size_x = 64) in;

layout(std430) buffer Found { vec4 found_light[]; };
layout(std430) readonly buffer LinkHits { uvec4 link_hits[]; };

uniform uint u_first;
uniform uint u_end;
uniform int u_n_rays;
uniform int u_n_points;

void main()
{
    uint side = u_first + gl_GlobalInvocationID.x;
    if (side >= u_end)
        return;
    Surface s = surface_of_side(side);
    mat3 frame = frame_of(s.normal);
    vec3 E = vec3(0.0);
    for (uint k = 0u; k < uint(u_n_rays); k++) {
        uvec4 hit = link_hits[k * u_n_sides + side];
        if (hit.x == BVH_NONE)
            continue;
        vec3 L = emission_of(hit.x, hit.y, uintBitsToFloat(hit.zw));
        if (L == vec3(0.0))
            continue;
        vec3 local = cosine_direction(sobol_point(k, hash(side))), d = frame * local;
        float pdf = float(u_n_rays) / float(u_n_points) * local.z / PI;
        E += L * (u_n_emitter_draws > 0 ? emitter_weight(s.position, s.normal, d, pdf, hit.x, hit.y) : 1.0);
    }
    found_light[side].rgb += E * (PI / float(u_n_rays));
}
