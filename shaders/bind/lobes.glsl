// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: all of a point that is not diffuse: lib/bsdf.glsl's Bsdf. Reflectances are halves.

#include "bind/wave.glsl"
#include "lib/bsdf.glsl"

const float MOST_OF_HALF = 65504.0;

uint at_lobes(uint set)
{
    return set + HIT_PLANES + POINT_PLANES;
}

uint halves(float a, float b)
{
    return packHalf2x16(clamp(vec2(a, b), -MOST_OF_HALF, MOST_OF_HALF));
}

// Two colours in three words.
uvec3 halves(vec3 a, vec3 b)
{
    return uvec3(halves(a.x, a.y), halves(a.z, b.x), halves(b.y, b.z));
}

void from_halves(uvec3 words, out vec3 a, out vec3 b)
{
    vec2 x = unpackHalf2x16(words.x), y = unpackHalf2x16(words.y), z = unpackHalf2x16(words.z);
    a = vec3(x, y.x);
    b = vec3(y.y, z);
}

void put_lobes(uint set, uint slot, Bsdf b)
{
    uint at = at_lobes(set);
    uvec3 metal = halves(b.metal_f0, b.metal_f90), dip = halves(b.metal_dip, b.glass_through);
    uvec3 coat = halves(b.coat_f0, b.coat_f90), glass = halves(b.glass_f0, b.glass_f90);
    wave[at_plane(at, slot)] = uvec4(floatBitsToUint(b.alpha.x), halves(b.alpha.y / max(b.alpha.x, 1e-12), b.turn),
                                     floatBitsToUint(vec2(b.coat_eta, b.glass_eta)));
    wave[at_plane(at + 1u, slot)] = uvec4(metal, dip.x);
    wave[at_plane(at + 2u, slot)] = uvec4(coat, dip.y);
    wave[at_plane(at + 3u, slot)] = uvec4(glass, dip.z);
    wave[at_plane(at + 4u, slot)] = uvec4(halves(b.glossy, b.transmission), uint(b.is_level));
}

// Without the ground.
Bsdf get_lobes(uint set, uint slot)
{
    uint at = at_lobes(set);
    uvec4 head = wave[at_plane(at, slot)], metal = wave[at_plane(at + 1u, slot)], coat = wave[at_plane(at + 2u, slot)],
          glass = wave[at_plane(at + 3u, slot)], albedo = wave[at_plane(at + 4u, slot)];
    vec2 shape = unpackHalf2x16(head.y), etas = uintBitsToFloat(head.zw);
    float alpha = uintBitsToFloat(head.x);
    Bsdf b = no_lobes(vec2(alpha, alpha * shape.x));
    b.turn = shape.y;
    b.coat_eta = etas.x;
    b.glass_eta = etas.y;
    b.is_level = albedo.w != 0u;
    from_halves(metal.xyz, b.metal_f0, b.metal_f90);
    from_halves(coat.xyz, b.coat_f0, b.coat_f90);
    from_halves(glass.xyz, b.glass_f0, b.glass_f90);
    from_halves(uvec3(metal.w, coat.w, glass.w), b.metal_dip, b.glass_through);
    from_halves(albedo.xyz, b.glossy, b.transmission);
    return b;
}
