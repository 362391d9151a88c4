// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    light of emissive triangles, drawn for points before any ray is traced: what they send out, their materials
//             know, and programs that trace know no materials.
// Formula:    E_perp = L / p, p the density of the tree's choice and of the direction [ContyEstevez18]
// In:         Wave: points; emissive triangles, materials
// Out:        Wave: draws, those of emitters, without their shadows
// Invocation: one point, both of its sides where light from behind shines through

#include "bind/emitter_draws.glsl"
#include "bind/list.glsl"

layout(local_size_x = 64) in;

uniform uint u_seed_offset;

void draw(uint slot)
{
    Point p = get_point(u_set, slot);
    if (!is_kind(p, POINT_SURFACE))
        return;
    Surface s = surface_of(p);
    uint seed = p.seed + u_seed_offset;
    int first = n_lamp_draws(u_n_tree_draws);
    for (int side = 0; side < (is_kind(p, POINT_BENDING) ? 2 : 1); side++) {
        for (int k = 0; k < u_n_emitter_draws; k++)
            put_draw(uint(side * n_draws() + first + k), slot, draw_emitter(k, s.position, s.normal, p.number, seed));
        s = turned_round(s);
        seed = hash(seed);
    }
}

void main()
{
    for (uint i = u_first + gl_GlobalInvocationID.x; i < n_slots(); i += u_step)
        draw(slot_of(i));
}
