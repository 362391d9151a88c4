// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    points whose material is a compiled node tree, one structure a program.
// In:         Wave: hits; triangles, materials, values
// Out:        Wave: points, and lobes where there are any
// Invocation: every u_step-th hit: those of this structure are looked for first, and then evaluated by all together

#include "bind/material_rows.glsl"
#include "bind/baked.glsl"
#include "bind/geo.glsl"
#include "evaluate/settle.glsl"
#include "nodes/tree.glsl"

uniform uint u_program;
uniform uint u_rays;         // RAY_* of the hits
uniform uint u_depth;
uniform bool u_wants_mean;   // what light sees that was spread, and the opacity as chance
uniform bool u_may_pass;     // whether what a tree lets through goes on behind it

bool is_ours(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    return is_surface(hit) && materials[material_of(hit.instance, hit.triangle)].program == u_program;
}

// The share of light that ends at the point. The eye's rays come to all points, those of paths have been let pass as it was baked.
// The eye's go on by the least of the channels; what else passes, coloured, is part of the point.
float stopped_share(Closures c, Hit hit)
{
    if (u_rays == RAY_CAMERA)
        return 1.0 - clamp(min(c.transparency.r, min(c.transparency.g, c.transparency.b)), 0.0, 1.0);
    uint at = baked_at(hit.instance, hit.triangle, hit.bary);
    return at == NOT_BAKED ? 1.0 : unpacked_cell(texelFetch(u_baked, int(at))).opacity;
}

void evaluate(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    vec3 wo = -hit.direction;
    Seen seen = seen_at(hit.instance, hit.triangle, hit.bary, wo);
    uint first = materials[seen.material].first_value;
    Geo g = geo_at(seen, hit.instance, hit.triangle, hit.bary, wo, hit.t, u_rays, u_depth, first);
    Closures c = no_closures(g, closure_chance(hit), u_wants_mean);
    surface(g, c);
    keep_finite(g, c);
    if (u_wants_mean) {
        put_look(slot, hit, seen.surface, c);
        return;
    }
    float opacity = stopped_share(c, hit);
    if (u_may_pass && opacity <= sobol_point(hit.number, hash(hit.seed + 17u)).x) {
        Point p = point_of(hit, seen.surface, seen.surface.normal);
        p.kind = POINT_PASSES;
        put_point(u_set, slot, p);
        return;
    }
    settle(slot, hit, seen.surface, c, opacity);
}
