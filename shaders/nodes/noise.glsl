// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: gradient noise [Perlin02] in 1 to 4 dimensions as Cycles has it, and the points that textures of it start at.
//          The number of dimensions n is a constant wherever these are called.

#include "nodes/hash.glsl"
#include "nodes/texture_space.glsl"

const vec4 NOISE_RANGE = vec4(0.25, 0.6616, 0.9820, 0.8344);  // by dimension: what takes it to [-1, 1]

float negated_if(float x, uint bit)
{
    return bit != 0u ? -x : x;
}

// The product of a corner's gradient, which its hash h chooses, and the way f from it.
float noise_gradient(uint h, vec4 f, int n)
{
    if (n == 1)
        return negated_if(float(1u + (h & 7u)) * f.x, h & 8u);
    if (n == 2) {
        bool swaps = (h & 4u) != 0u;
        return negated_if(swaps ? f.y : f.x, h & 1u) + negated_if(2.0 * (swaps ? f.x : f.y), h & 2u);
    }
    if (n == 3) {
        h &= 15u;
        float u = h < 8u ? f.x : f.y, v = h < 4u ? f.y : h == 12u || h == 14u ? f.x : f.z;
        return negated_if(u, h & 1u) + negated_if(v, h & 2u);
    }
    h &= 31u;
    float u = h < 24u ? f.x : f.y, v = h < 16u ? f.y : f.z, s = h < 8u ? f.z : f.w;
    return negated_if(u, h & 1u) + negated_if(v, h & 2u) + negated_if(s, h & 4u);
}

// Noise in [-1, 1]. It repeats after 100000, beyond which floats tell no neighbours apart.
float noise_signed(vec4 p, int n)
{
    p += 0.5 * vec4(greaterThanEqual(abs(p), vec4(1e6))) - 1e5 * trunc(p / 1e5);
    vec4 corner = floor(p), f = p - corner, share = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    float sum = 0.0;
    for (int i = 0, end = turns(1 << n, p); i < end; i++) {
        ivec4 far = ivec4(i, i >> 1, i >> 2, i >> 3) & 1;
        vec4 weight = mix(1.0 - share, share, vec4(far));
        sum += weight.x * weight.y * weight.z * weight.w
            * noise_gradient(jenkins(uvec4(ivec4(corner) + far), n), f - vec4(far), n);
    }
    return NOISE_RANGE[n - 1] * sum;
}

// Where several noises of one texture are far from each other.
vec4 noise_offset(float seed, int n)
{
    if (n == 1)
        return vec4(100.0 + 100.0 * hash_of(vec4(seed), 1), 0.0, 0.0, 0.0);
    vec4 h = vec4(hash_of_2(seed, 0.0), hash_of_2(seed, 1.0), hash_of_2(seed, 2.0), hash_of_2(seed, 3.0));
    return (100.0 + 100.0 * h) * vec4(lessThan(ivec4(0, 1, 2, 3), ivec4(n)));
}

// The point p of a channel of a colour, red (0) to blue (2).
vec4 noise_channel(vec4 p, int n, int channel)
{
    return channel == 0 ? p : p + noise_offset(float(n - 1 + channel), n);
}

// The point to look up, moved by noise.
vec4 noise_point(int n, vec3 at, float w, float scale, float distortion)
{
    vec4 p = texture_point(n, at, w, scale), moved = p;
    if (distortion != 0.0)
        for (int i = 0, end = turns(n, p); i < end; i++)
            moved[i] += noise_signed(p + noise_offset(float(i), n), n) * distortion;
    return moved;
}

float noise_detail(float detail)
{
    return clamp(detail, 0.0, 15.0);
}
