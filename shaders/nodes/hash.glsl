// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the hashes that textures draw from, with the numbers that Cycles has: Jenkins' lookup3 [Jenkins06] of whole
//          numbers and of the bits of floats, and permuted congruential hashes [Jarzynski20] of cells.

uint rotated(uint x, int by)
{
    return x << by | x >> (32 - by);
}

// The three words at the end of lookup3 as one.
uint jenkins_end(uint a, uint b, uint c)
{
    c = (c ^ b) - rotated(b, 14);
    a = (a ^ c) - rotated(c, 11);
    b = (b ^ a) - rotated(a, 25);
    c = (c ^ b) - rotated(b, 16);
    a = (a ^ c) - rotated(c, 4);
    b = (b ^ a) - rotated(a, 14);
    return (c ^ b) - rotated(b, 24);
}

// Of the first n words, of 1 to 4.
uint jenkins(uvec4 k, int n)
{
    uint start = 0xdeadbeefu + (uint(n) << 2) + 13u;
    uint a = start + k.x, b = start + (n > 1 ? k.y : 0u), c = start + (n > 2 ? k.z : 0u);
    if (n == 4) {
        a = (a - c) ^ rotated(c, 4);
        c += b;
        b = (b - a) ^ rotated(a, 6);
        a += c;
        c = (c - b) ^ rotated(b, 8);
        b += a;
        a = (a - c) ^ rotated(c, 16);
        c += b;
        b = (b - a) ^ rotated(a, 19);
        a += c;
        c = (c - b) ^ rotated(b, 4);
        b += a;
        a += k.w;
    }
    return jenkins_end(a, b, c);
}

// In [0, 1], of the bits of the first n numbers.
float hash_of(vec4 k, int n)
{
    return float(jenkins(floatBitsToUint(k), n)) * (1.0 / 4294967295.0);
}

float hash_of_2(float x, float y)
{
    return hash_of(vec4(x, y, 0.0, 0.0), 2);
}

float hash_of_3(vec3 k)
{
    return hash_of(vec4(k, 0.0), 3);
}

// Of whole numbers, in [0, 1].
vec2 hash_of_cell_2(ivec2 v)
{
    v = v * 1664525 + 1013904223;
    v.x += v.y * 1664525;
    v.y += v.x * 1664525;
    v ^= v >> 16;
    v.x += v.y * 1664525;
    v.y += v.x * 1664525;
    return vec2(v & 0x7fffffff) * (1.0 / 2147483647.0);
}

vec3 hash_of_cell_3(ivec3 v)
{
    v = v * 1664525 + 1013904223;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3(v & 0x7fffffff) * (1.0 / 2147483647.0);
}

vec4 hash_of_cell_4(ivec4 v)
{
    v = v * 1664525 + 1013904223;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return vec4(v & 0x7fffffff) * (1.0 / 2147483647.0);
}
