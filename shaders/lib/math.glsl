// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: constants, unit vectors in 32 bits, frames, quasi-random numbers.

const float PI = 3.14159265358979;
const float INFINITE = 1e30;  // farther than anything

// Octahedral unit vector as two 16-bit signed normals [Meyer10]; within 1e-4 of the original.
uint pack_unit(vec3 v)
{
    v /= abs(v.x) + abs(v.y) + abs(v.z);
    vec2 folded = (1.0 - abs(v.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v.xy, vec2(0.0)));
    return packSnorm2x16(v.z < 0.0 ? folded : v.xy);
}

vec3 unpack_unit(uint bits)
{
    vec2 p = unpackSnorm2x16(bits);
    vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-v.z, 0.0);
    v.xy -= mix(vec2(-fold), vec2(fold), greaterThanEqual(v.xy, vec2(0.0)));
    return normalize(v);
}

// Tangent and bitangent of the unit vector n, right-handed, continuous but for n.z = 0 [Duff17].
mat3 frame_of(vec3 n)
{
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// A permuted congruential hash [Jarzynski20].
uint hash(uint x)
{
    x = x * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
    return (x >> 22u) ^ x;
}

// Owen's scrambling of a number whose bits are reversed: what it does to a bit depends on the ones below it alone
// [Laine11], with the constants of [Vegdahl21].
uint scramble_reversed(uint x, uint seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// The second coordinate of Sobol's sequence, bits reversed: Pascal's triangle modulo 2 times the index.
uint sobol_reversed(uint i)
{
    i ^= (i & 0xaaaaaaaau) >> 1u;
    i ^= (i & 0xccccccccu) >> 2u;
    i ^= (i & 0xf0f0f0f0u) >> 4u;
    i ^= (i & 0xff00ff00u) >> 8u;
    return i ^ (i >> 16u);
}

// Point number i of Sobol's sequence in the plane, Owen-scrambled, in the order and with the digits that `seed` gives
// [Burley20]: sequences of different seeds know nothing of each other. In [0, 1)^2, the same bits everywhere.
vec2 sobol_point(uint i, uint seed)
{
    uint index = bitfieldReverse(scramble_reversed(bitfieldReverse(i), hash(seed)));
    uvec2 p = uvec2(scramble_reversed(index, hash(seed ^ 0x9e3779b9u)),
                    scramble_reversed(sobol_reversed(index), hash(seed ^ 0x7f4a7c15u)));
    return vec2(bitfieldReverse(p) >> 8u) / 16777216.0;
}

// Number of a place along the Z-order curve: the bits of x and y in turns [Morton66]. Up to 65535 each.
uint z_order(uvec2 at)
{
    at &= 0xffffu;
    at = (at | at << 8u) & 0x00ff00ffu;
    at = (at | at << 4u) & 0x0f0f0f0fu;
    at = (at | at << 2u) & 0x33333333u;
    at = (at | at << 1u) & 0x55555555u;
    return at.x | at.y << 1u;
}

// Uniform on the unit disk, area preserving and without seams [Shirley97].
vec2 disk_point(vec2 u)
{
    vec2 p = 2.0 * u - 1.0;
    if (p.x == 0.0 && p.y == 0.0)
        return vec2(0.0);
    bool wide = abs(p.x) > abs(p.y);
    float r = wide ? p.x : p.y;
    float phi = wide ? PI / 4.0 * p.y / p.x : PI / 2.0 - PI / 4.0 * p.x / p.y;
    return r * vec2(cos(phi), sin(phi));
}

// Direction around +z, distributed as its cosine over pi.
vec3 cosine_direction(vec2 u)
{
    vec2 p = disk_point(u);
    return vec3(p, sqrt(max(1.0 - dot(p, p), 0.0)));
}

// Pixel of invocation i: the picture in tiles of 8 by 8, so that neighbours work on the same things.
ivec2 tiled_pixel(uint i, ivec2 size)
{
    uint tiles_x = uint(size.x + 7) / 8u, tile = i / 64u;
    return ivec2(tile % tiles_x, tile / tiles_x) * 8 + ivec2(i % 8u, i / 8u % 8u);
}
