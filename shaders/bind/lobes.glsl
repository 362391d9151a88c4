// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: all of a point that is not diffuse: lib/bsdf.glsl's Bsdf, and the direction that it is seen from.

#include "bind/wave.glsl"
#include "lib/bsdf.glsl"

void put_lobes(uint set, uint slot, vec3 wo, Bsdf b)
{
    uint at = set + HIT_PLANES + POINT_PLANES;
    put(at, slot, wo, b.alpha);
    put(at + 1u, slot, b.metal, b.coat_eta);
    put(at + 2u, slot, b.metal_f0, b.glass_eta);
    put(at + 3u, slot, b.metal_dip, 0.0);
    put(at + 4u, slot, b.coat, 0.0);
    put(at + 5u, slot, b.coat_f0, 0.0);
    put(at + 6u, slot, b.glass, 0.0);
    put(at + 7u, slot, b.glass_f0, 0.0);
    put(at + 8u, slot, b.glass_tint, 0.0);
    put(at + 9u, slot, b.glossy, 0.0);
    put(at + 10u, slot, b.transmission, 0.0);
}

// Without the ground.
Bsdf get_lobes(uint set, uint slot, out vec3 wo)
{
    uint at = set + HIT_PLANES + POINT_PLANES;
    vec4 a = get(at, slot), b = get(at + 1u, slot), c = get(at + 2u, slot);
    wo = a.xyz;
    return Bsdf(vec3(0.0), a.w, b.xyz, c.xyz, get(at + 3u, slot).xyz, get(at + 4u, slot).xyz, get(at + 5u, slot).xyz, b.w,
                get(at + 6u, slot).xyz, get(at + 7u, slot).xyz, get(at + 8u, slot).xyz, c.w, get(at + 9u, slot).xyz,
                get(at + 10u, slot).xyz);
}
