// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    how much of the emission that a path finds counts, since emissive triangles are drawn as well [Veach95].
// In:         Wave: points, from which the paths start; what they met
// Out:        Wave: weights of hits
// Invocation: one path

#include "bind/emitters.glsl"
#include "bind/list.glsl"

layout(local_size_x = 64) in;

uniform uint u_met;  // planes of what was met

void weigh(uint slot)
{
    Hit hit = get_hit(u_met, slot);
    if (hit.instance >= HIT_DONE)
        return;
    Point p = get_point(u_set, slot);
    hit.weight = emitter_weight(p.position, p.normal, hit.direction, hit.pdf, hit.instance, hit.triangle);
    put_hit(u_met, slot, hit);
}

void main()
{
    for (uint i = u_first + gl_GlobalInvocationID.x; i < n_slots(); i += u_step)
        weigh(slot_of(i));
}
