// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: a point with its lobes, as programs that trace read it.

#include "bind/lobes.glsl"

const float ROUGH = 0.25;   // alpha from which a met surface mirrors what arrives from everywhere, not what one ray finds

uint kind_of(Bsdf b)
{
    bool has_lobes = b.glossy + b.transmission != vec3(0.0), is_rough = min(b.alpha.x, b.alpha.y) >= ROUGH && !has_glass(b);
    return (has_lobes ? POINT_LOBES : 0u) | (is_smooth(b) ? POINT_SMOOTH : 0u)
         | (has_glass(b) && is_bending(b) ? POINT_BENDING : 0u) | (is_rough ? POINT_ROUGH : 0u);
}

// Paths go on with twice the albedo as probability.
void put_shaded(uint slot, Point p, Bsdf b)
{
    vec3 albedo = b.glossy + b.transmission;
    p.kind |= kind_of(b);
    p.chance = min(2.0 * max(albedo.r, max(albedo.g, albedo.b)), 1.0);
    put_point(u_set, slot, p);
    if (is_kind(p, POINT_LOBES))
        put_lobes(u_set, slot, b);
}
