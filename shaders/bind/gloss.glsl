// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: radiance towards the eye that was not diffuse at the first hit, straight from lights or by way of other surfaces.

#include "bind/wave.glsl"

uniform uint u_gloss;

struct Gloss {
    vec3 glossy_direct;
    float apartness;      // the part of the way from the eye to what a surface reflects that lies behind it; 0: they touch
    vec3 glossy_indirect;
    vec3 transmission_direct;
    vec3 transmission_indirect;
};

const uint GLOSSY_DIRECT_PLANE = 0u;
const uint GLOSSY_INDIRECT_PLANE = 1u;
const uint TRANSMISSION_DIRECT_PLANE = 2u;
const uint TRANSMISSION_INDIRECT_PLANE = 3u;

void put_gloss(uint slot, Gloss g)
{
    put(u_gloss + GLOSSY_DIRECT_PLANE, slot, g.glossy_direct, g.apartness);
    put(u_gloss + GLOSSY_INDIRECT_PLANE, slot, g.glossy_indirect, 0.0);
    put(u_gloss + TRANSMISSION_DIRECT_PLANE, slot, g.transmission_direct, 0.0);
    put(u_gloss + TRANSMISSION_INDIRECT_PLANE, slot, g.transmission_indirect, 0.0);
}

Gloss get_gloss(uint slot)
{
    vec4 a = get(u_gloss + GLOSSY_DIRECT_PLANE, slot);
    return Gloss(a.xyz, a.w, get(u_gloss + GLOSSY_INDIRECT_PLANE, slot).xyz, get(u_gloss + TRANSMISSION_DIRECT_PLANE, slot).xyz,
                 get(u_gloss + TRANSMISSION_INDIRECT_PLANE, slot).xyz);
}

// is_through: whether the path began through the surface; is_direct: whether the light came straight from where it shines.
void add_gloss(uint slot, bool is_through, bool is_direct, vec3 L)
{
    if (L == vec3(0.0))
        return;
    uint plane = u_gloss + (is_through ? TRANSMISSION_DIRECT_PLANE : GLOSSY_DIRECT_PLANE) + uint(!is_direct);
    vec4 sum = get(plane, slot);
    put(plane, slot, sum.xyz + L, sum.w);
}
