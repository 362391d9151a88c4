// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: from a hit to the point that a material's program fills in.

#include "bind/geometry.glsl"
#include "bind/list.glsl"

layout(local_size_x = 64) in;

// What a point has in common with the hit that it comes from, and its surface.
Point point_of(Hit hit, Surface s, vec3 normal)
{
    return Point(POINT_SURFACE, s.position, hit.number, normal, hit.seed, s.normal_geometric, hit.t, vec3(0.0), 0.0, s.lift,
                 hit.weight, vec3(0.0));
}

// Where a ray met nothing, or need not look.
Point no_point(Hit hit)
{
    Surface none = Surface(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    Point p = point_of(hit, none, vec3(0.0));
    p.kind = hit.instance == HIT_DONE ? POINT_DONE : 0u;
    return p;
}

bool is_surface(Hit hit)
{
    return hit.instance < HIT_DONE;
}

// Whether this program fills in the slot.
bool is_ours(uint slot);

// Fill it in.
void evaluate(uint slot);

// Slots are looked for first, and then filled in by all together: what nobody has is not computed.
void main()
{
    uint i = u_first + gl_GlobalInvocationID.x, n = i < u_end ? n_slots() : 0u;
    while (true) {
        while (i < n && !is_ours(slot_of(i)))
            i += u_step;
        if (i >= n)
            break;
        evaluate(slot_of(i));
        i += u_step;
    }
}
