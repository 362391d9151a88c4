// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the emission that diffuse rays met: materials know it, and programs that trace know no materials.
// Formula:    E += pi / N sum w Le(w_i); w is the weight beside draws of the same light [Veach95]
// In:         Wave: points, what their diffuse rays met; triangles, materials, emissive triangles
// Out:        Wave: arrivals
// Invocation: one pixel

#include "bind/emitters.glsl"
#include "bind/emission.glsl"
#include "bind/shapes.glsl"

layout(local_size_x = 64) in;

uniform int u_n_rays;
uniform uint u_ends;

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x;
    if (slot >= u_end)
        return;
    Point p = get_point(u_set, slot);
    if (!is_kind(p, POINT_SURFACE))
        return;
    mat3 frame = frame_of(p.normal);
    vec3 found = vec3(0.0);
    for (int k = 0; k < u_n_rays; k++) {
        uvec4 hit = wave[at_plane(u_ends + uint(k), slot)];
        if (hit.x == BVH_NONE)
            continue;
        vec3 L = emission_of(hit.x, hit.y, uintBitsToFloat(hit.zw));
        if (L == vec3(0.0))
            continue;
        vec3 local = cosine_direction(sobol_point(p.number * uint(u_n_rays) + uint(k), p.seed));
        float pdf = float(u_n_rays) * local.z / PI;
        found += ground_factor(p, slot, frame * local) * L * (u_n_emitter_draws > 0 ? emitter_weight(p.position, p.normal, frame * local, pdf, hit.x, hit.y) : 1.0);
    }
    if (found == vec3(0.0))
        return;
    Arrival a = get_arrival(slot);
    a.indirect += found * (PI / float(u_n_rays));
    a.found += found * (PI / float(u_n_rays));
    put_arrival(slot, a);
}
