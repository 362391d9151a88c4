// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    points whose tree goes on with the light that they send to the eye, as a colour (Shader to RGB): once they are
//             lit, they send out what the tree makes of that, and reflect nothing.
// In:         Wave: hits, points, arrivals, gloss; triangles, materials, values
// Out:        Wave: points
// Invocation: every u_step-th hit: those of this structure are looked for first, and then evaluated by all together

#include "bind/gloss.glsl"
#include "bind/material_rows.glsl"
#include "bind/geo.glsl"
#include "evaluate/hit.glsl"
#include "nodes/closures.glsl"
#include "nodes/style.glsl"
#include "nodes/tree.glsl"

uniform uint u_program;

bool is_ours(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    bool is_there = is_surface(hit) && (get_word(u_set + HIT_PLANES, slot) & POINT_SURFACE) != 0u;
    return is_there && materials[material_of(hit.instance, hit.triangle)].program == u_program;
}

vec3 light_of(uint slot, Point p)
{
    Arrival E = get_arrival(slot);
    vec3 L = p.emission + p.diffuse / PI * (E.direct + E.indirect);
    if (is_kind(p, POINT_LOBES)) {
        Gloss g = get_gloss(slot);
        L += g.glossy_direct + g.glossy_indirect + g.transmission_direct + g.transmission_indirect;
    }
    return L;
}

void evaluate(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    Point p = get_point(u_set, slot);
    vec3 wo = -hit.direction;
    Seen seen = seen_at(hit.instance, hit.triangle, hit.bary, wo);
    Geo g = geo_at(seen, hit.instance, hit.triangle, hit.bary, wo, hit.t, RAY_CAMERA, 0u, materials[seen.material].first_value);
    lit_light = light_of(slot, p);
    Closures c = no_closures(g, 0.5, true);
    styled(g, c);
    p.kind = POINT_SURFACE;
    p.diffuse = vec3(0.0);
    p.chance = 0.0;
    p.lift = vec3(0.0);
    p.emission = c.emission;
    put_point(u_set, slot, p);
}
