// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one more bounce: each side of each surfel gathers what the others sent out before. Double-buffered, so that
//             the order of invocations does not matter; the rays are the same in every sweep, so that sweeps converge.
// Formula:    E = pi / N sum L(w_i), w_i distributed as cos; L' = Le + rho / pi (E_lamps + E)
// In:         Surfels, Cache: RADIANCE of the sweep before and LAMPS; world, triangles
// Out:        Cache: the other RADIANCE, INDIRECT; Change: largest change of any L (bits of a positive float)
// Invocation: one side of one surfel

#include "bind/cache.glsl"
#include "bind/environment.glsl"
#include "bind/trace.glsl"

const int N_RAYS = 16;

layout(local_size_x = 64) in;

layout(std430) buffer Change { uint largest_change; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_from;  // 0 or 1: the radiance that is read; the other is written

vec3 arriving(vec3 o, vec3 d, uint seed)
{
    Hit hit;
    if (!trace_closest(o, d, INFINITE, seed, hit))
        return world_radiance(d, 0.0);
    uvec4 corners = triangles[hit.triangle];
    vec3 a = vertex_ws(hit.instance, corners.x);
    vec3 n = cross(vertex_ws(hit.instance, corners.y) - a, vertex_ws(hit.instance, corners.z) - a);
    uint side = cache_side(o + hit.t * d, n, d);
    return side == NOTHING ? vec3(0.0) : cache[cache_entry(RADIANCE + u_from, side)].rgb;
}

void main()
{
    uint side = u_first + gl_GlobalInvocationID.x;
    if (side >= u_end)
        return;
    Surfel s = surfels[side / 2u];
    vec3 n = unpack_unit(s.normal) * (side % 2u == 0u ? 1.0 : -1.0);
    vec3 o = side_position(s, side, n), E = vec3(0.0);
    mat3 frame = frame_of(n);
    for (int k = 0; k < N_RAYS; k++)
        E += PI / float(N_RAYS) * arriving(o, frame * cosine_direction(r2_point(uint(k), hash(side))), hash(side) + uint(k));
    cache[cache_entry(INDIRECT, side)] = vec4(E, 0.0);
    vec3 L = s.emission + s.albedo / PI * (cache[cache_entry(LAMPS, side)].rgb + E);
    vec3 change = abs(L - cache[cache_entry(RADIANCE + u_from, side)].rgb);
    cache[cache_entry(RADIANCE + 1u - u_from, side)] = vec4(L, 0.0);
    atomicMax(largest_change, floatBitsToUint(max(change.r, max(change.g, change.b))));
}
