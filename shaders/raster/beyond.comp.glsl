// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what the eye sees behind surfaces that have let its ray pass.
// In:         Wave: hits, points; camera, BVH
// Out:        Wave: hits of those; Next: their list, whose order is of no consequence
// Invocation: every u_step-th slot

#include "bind/list.glsl"
#include "bind/trace.glsl"
#include "raster/eye.glsl"

layout(std430) buffer Next { uint next[]; };

uniform float u_depth;  // from the near to the far plane, in lengths of the direction that u_ray_direction gives

bool has_passed(uint slot)
{
    return (get_word(u_set + HIT_PLANES, slot) & POINT_PASSES) != 0u;
}

void look_on(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    Point p = get_point(u_set, slot);
    float far = u_depth * length(u_ray_direction * clip_position(vec2(pixel_of(slot)) + 0.5));
    vec3 o = offset_origin(p.position, p.normal_geometric, hit.direction);
    Crossing c;
    trace_closest(o, hit.direction, max(far - hit.t, 0.0), 0u, c);
    put_hit(u_set, slot, Hit(c.instance, c.triangle, c.bary, hit.direction, hit.t + c.t, hit.number, hash(hit.seed), INFINITE, 1.0));
    next[LIST_HEAD + atomicAdd(next[0], 1u)] = slot;
}

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x, n = n_slots();
    while (true) {
        while (i < n && !has_passed(slot_of(i)))
            i += u_step;
        if (i >= n)
            break;
        look_on(slot_of(i));
        i += u_step;
    }
}
