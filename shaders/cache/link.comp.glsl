// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what each side of each surfel sees: its rays are traced once, and all bounces go along these links. They are the
//             same in every sweep, so that sweeps converge.
// Formula:    E_sky = pi / N sum L(w_i) of the rays that leave the scene, w_i distributed as cos
// In:         Surfels, world, triangles
// Out:        Links: the side that each ray hits, or NOTHING; Cache: STILL
// Invocation: one side of one surfel

#include "bind/cache.glsl"
#include "bind/environment.glsl"
#include "bind/trace.glsl"

const int N_RAYS = 16;

layout(std430) writeonly buffer Links { uint links[]; };  // N_RAYS a side: the first of all sides, the second of all ...

uniform uint u_first;
uniform uint u_end;

// The side of the cache that a ray hits.
uint side_hit(vec3 o, vec3 d, Hit hit)
{
    uvec4 corners = triangles[hit.triangle];
    vec3 a = vertex_ws(hit.instance, corners.x);
    vec3 n = cross(vertex_ws(hit.instance, corners.y) - a, vertex_ws(hit.instance, corners.z) - a);
    return cache_side(o + hit.t * d, n, d);
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
    for (uint k = 0u; k < uint(N_RAYS); k++) {
        vec3 d = frame * cosine_direction(sobol_point(k, hash(side)));
        Hit hit;
        bool is_hit = trace_closest(o, d, INFINITE, hash(side) + k, hit);
        links[k * u_n_sides + side] = is_hit ? side_hit(o, d, hit) : NOTHING;
        if (!is_hit)
            E += PI / float(N_RAYS) * world_radiance(d, 0.0);
    }
    cache[cache_entry(STILL, side)] = vec4(E, 0.0);
}
