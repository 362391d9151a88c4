// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    points whose material is a compiled node tree, one structure a program.
// In:         Wave: hits; triangles, materials, values
// Out:        Wave: points, and lobes where there are any
// Invocation: every u_step-th hit: those of this structure are looked for first, and then evaluated by all together

#include "bind/lobes.glsl"
#include "bind/material_rows.glsl"
#include "bind/geo.glsl"
#include "evaluate/hit.glsl"
#include "nodes/closures.glsl"
#include "nodes/tree.glsl"

uniform uint u_program;
uniform uint u_rays;         // RAY_* of the hits
uniform uint u_depth;
uniform bool u_wants_mean;
uniform bool u_may_pass;     // whether what a tree lets through goes on behind it

bool is_ours(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    return is_surface(hit) && materials[material_of(hit.instance, hit.triangle)].program == u_program;
}

void evaluate(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    vec3 wo = -hit.direction;
    Seen seen = seen_at(hit.instance, hit.triangle, hit.bary, wo);
    uint first = materials[seen.material].first_value;
    Geo g = geo_at(seen, hit.instance, hit.triangle, hit.bary, wo, hit.t, u_rays, u_depth, first);
    Closures c = no_closures(g, 0.0, u_wants_mean);
    surface(g, c);
    Point p = point_of(hit, seen.surface, facing(c.normal, wo));
    float opacity = 1.0 - clamp(dot(c.transparency, vec3(1.0 / 3.0)), 0.0, 1.0);
    if (u_may_pass && opacity <= sobol_point(hit.number, hash(hit.seed + 17u)).x) {
        p.kind = POINT_PASSES;
        put_point(u_set, slot, p);
        return;
    }
    // Rays come here that opacity has not let pass: what of them is left counts for all
    float share = u_wants_mean ? 1.0 : 1.0 / max(opacity, 1e-4);
    p.diffuse = share * c.diffuse;
    p.emission = share * c.emission;
    p.chance = u_wants_mean ? opacity : 0.0;
    put_point(u_set, slot, p);
}
