// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: all of a point that is not diffuse: lib/bsdf.glsl's Bsdf. Reflectances are halves;
// those of glass are parts of the largest of them in 16 bits, since light meets it often, and what is lost adds up.

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

float most_of(vec3 c)
{
    return max(c.r, max(c.g, c.b));
}

// Two colours in three words, in parts of 1.
uvec3 parts_of_one(vec3 a, vec3 b)
{
    return uvec3(packUnorm2x16(a.xy), packUnorm2x16(vec2(a.z, b.x)), packUnorm2x16(b.yz));
}

void from_parts(uvec3 words, float one, out vec3 a, out vec3 b)
{
    vec2 x = unpackUnorm2x16(words.x), y = unpackUnorm2x16(words.y), z = unpackUnorm2x16(words.z);
    a = one * vec3(x, y.x);
    b = one * vec3(y.y, z);
}

void put_lobes(uint set, uint slot, Bsdf b)
{
    uint at = at_lobes(set);
    float one = max(max(most_of(b.glass_f0), most_of(b.glass_f90)), max(most_of(b.glass_through), 1e-30));
    uvec3 metal = halves(b.metal_f0, b.metal_f90), dip = halves(b.metal_dip, vec3(0.0));
    uvec3 coat = halves(b.coat_f0, b.coat_f90), glass = parts_of_one(b.glass_f0 / one, b.glass_f90 / one);
    uvec3 through = parts_of_one(vec3(0.0), b.glass_through / one);
    wave[at_plane(at, slot)] = uvec4(floatBitsToUint(b.alpha.x), halves(b.alpha.y / max(b.alpha.x, 1e-12), b.turn),
                                     floatBitsToUint(vec2(b.coat_eta, b.glass_eta)));
    wave[at_plane(at + 1u, slot)] = uvec4(metal, dip.x);
    wave[at_plane(at + 2u, slot)] = uvec4(coat, dip.y | through.y);
    wave[at_plane(at + 3u, slot)] = uvec4(glass, through.z);
    wave[at_plane(at + 4u, slot)] = uvec4(halves(b.glossy, b.transmission), floatBitsToUint(b.is_level ? -one : one));
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
    float one = uintBitsToFloat(albedo.w);
    b.is_level = one < 0.0;
    from_halves(metal.xyz, b.metal_f0, b.metal_f90);
    from_halves(coat.xyz, b.coat_f0, b.coat_f90);
    from_parts(glass.xyz, abs(one), b.glass_f0, b.glass_f90);
    vec3 unused;
    from_halves(uvec3(metal.w, coat.w, 0u), b.metal_dip, unused);
    from_parts(uvec3(0u, coat.w, glass.w), abs(one), unused, b.glass_through);
    from_halves(albedo.xyz, b.glossy, b.transmission);
    return b;
}
