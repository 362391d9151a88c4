// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    points whose material reflects diffusely and has no image: a quick program for what most walls are made of. It
//             also fills in the points of rays that met nothing.
// In:         Wave: hits; triangles, materials
// Out:        Wave: points
// Invocation: one hit

#include "bind/material_rows.glsl"
#include "evaluate/hit.glsl"

bool is_ours(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    return !is_surface(hit) || materials[material_of(hit.instance, hit.triangle)].program == PROGRAM_MATTE;
}

void evaluate(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    if (!is_surface(hit)) {
        put_point(u_set, slot, no_point(hit));
        return;
    }
    Material m = materials[material_of(hit.instance, hit.triangle)];
    Seen seen = seen_at(hit.instance, hit.triangle, hit.bary, -hit.direction);
    Point p = point_of(hit, seen.surface, facing(seen.surface.normal, -hit.direction));
    p.diffuse = max(m.base_color, 0.0);
    p.emission = m.emission;
    put_point(u_set, slot, p);
}
