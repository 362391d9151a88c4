// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what the eye sees through a pixel, as hits of rays.

#include "bind/pixels.glsl"
#include "bind/tiles.glsl"
#include "bind/wave.glsl"

uniform uint u_sample;
uniform uint u_n_samples;  // of the picture, rounded up to a power of 2
uniform uint u_seed;

// A hit of the ray through a pixel's centre. Its random numbers: pixels one after another along a Z-order curve, u_n_samples
// each, so that neighbours share the square of a sequence as evenly as the samples of one pixel do, and little noise is left
// where a filter joins them [Ahmed20].
Hit eye_hit(ivec2 pixel, float t, uint instance, uint triangle, vec2 bary)
{
    vec3 origin, direction;
    camera_ray(vec2(pixel) + 0.5, origin, direction);
    uint number = z_order(uvec2(pixel)) * u_n_samples + u_sample;
    return Hit(instance, triangle, bary, direction, t, number, hash(u_seed), INFINITE, 1.0);
}
