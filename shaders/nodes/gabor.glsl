// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: Gabor noise [Lagae09], with as many kernels in each cell of a grid and weights of 1 and -1 [Tavernier19], as a
//          phasor [Tricard19].

#include "nodes/hash.glsl"
#include "nodes/texture_space.glsl"

const int KERNELS = 8;  // in a cell

struct Gabor {
    float value;
    float phase;
    float intensity;
};

// One kernel at v from its centre: a wave within a bell that ends at a distance of 1.
vec2 gabor_kernel(vec3 v, vec3 frequency)
{
    float dd = dot(v, v), bell = exp(-3.14159265359 * dd) * (0.5 + 0.5 * cos(3.14159265359 * dd));
    float angle = 6.28318530718 * dot(v, frequency);
    return bell * vec2(cos(angle), sin(angle));
}

// deviation: six times that of sums of kernels
Gabor gabor_of(vec2 sum, float deviation)
{
    float phase = sum == vec2(0.0) ? 0.0 : atan(sum.y, sum.x);
    return Gabor(finite(0.5 * sum.y / deviation + 0.5), finite(phase / 6.28318530718 + 0.5), finite(length(sum) / deviation));
}

// orientation: radians
Gabor texture_gabor_2d(vec3 at, float scale, float frequency, float anisotropy, float orientation)
{
    vec2 p = at.xy * scale, corner = floor(p), sum = vec2(0.0);
    float isotropy = 1.0 - clamp(anisotropy, 0.0, 1.0);
    for (int i = 0, end = turns(9 * KERNELS, vec4(p, 0.0, 0.0)); i < end; i++) {
        int cell = i / KERNELS, first = 3 * (i % KERNELS);
        vec2 around = vec2(cell % 3 - 1, cell / 3 - 1);
        vec3 seed = vec3(corner + around, float(first + 1));
        vec2 v = p - corner - around - vec2(hash_of_3(seed), hash_of_3(seed.zxy));
        if (dot(v, v) < 1.0) {
            float angle = orientation + (hash_of_3(vec3(seed.xy, float(first))) - 0.5) * 3.14159265359 * isotropy;
            vec2 wave = gabor_kernel(vec3(v, 0.0), max(frequency, 0.001) * vec3(cos(angle), sin(angle), 0.0));
            sum += hash_of_3(vec3(seed.xy, float(first + 2))) < 0.5 ? -wave : wave;
        }
    }
    return gabor_of(sum, 6.0);
}

// The direction at angles from that of `angles`, inclination and azimuth.
vec3 gabor_direction(vec2 angles)
{
    return vec3(sin(angles.x) * vec2(cos(angles.y), sin(angles.y)), cos(angles.x));
}

Gabor texture_gabor_3d(vec3 at, float scale, float frequency, float anisotropy, vec3 orientation)
{
    vec3 p = at * scale, corner = floor(p);
    vec2 sum = vec2(0.0);
    float isotropy = 1.0 - clamp(anisotropy, 0.0, 1.0), l = length(orientation), across = length(orientation.xy);
    orientation = l > 0.0 ? orientation / l : vec3(0.0);
    vec2 angles = vec2(acos(clamp(orientation.z, -1.0, 1.0)), across > 0.0 ? atan(orientation.y, orientation.x) : 0.0);
    for (int i = 0, end = turns(27 * KERNELS, vec4(p, 0.0)); i < end; i++) {
        int cell = i / KERNELS, first = 3 * (i % KERNELS);
        vec3 around = vec3(cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1);
        vec4 seed = vec4(corner + around, float(first + 1));
        vec3 v = p - corner - around - vec3(hash_of(seed, 4), hash_of(seed.zxwy, 4), hash_of(seed.wzyx, 4));
        if (dot(v, v) < 1.0) {
            vec4 turned = vec4(seed.xyz, float(first));
            vec2 by = 3.14159265359 * vec2(hash_of(turned, 4), hash_of(turned.zxwy, 4));
            vec3 way = isotropy > 0.0 ? gabor_direction(angles + by * isotropy) : orientation;
            vec2 wave = gabor_kernel(v, max(frequency, 0.001) * way);
            sum += hash_of(vec4(seed.xyz, float(first + 2)), 4) < 0.5 ? -wave : wave;
        }
    }
    return gabor_of(sum, 5.0453784915);
}
