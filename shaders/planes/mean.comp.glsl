// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one of Blender's render passes: planes of the film, added up and divided by the samples or by an albedo.
// Formula:    (sum(plane_i) - sum(plane_j)) / n, or / plane_d where that is not 0
// In:         u_film
// Out:        u_mean
// Invocation: one pixel

#include "bind/film.glsl"
#include "bind/samples.glsl"

layout(local_size_x = 64) in;

layout(rgba32f) uniform writeonly image2D u_mean;
uniform sampler2DArray u_film;

uniform uint u_first;
uniform uint u_end;
uniform ivec2 u_size;
uniform uint u_plus;    // bit i: layer i is added
uniform uint u_minus;   // or taken off
uniform int u_divisor;  // layer; -1: the number of samples

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    vec4 sum = vec4(0.0);
    for (uint rest = u_plus | u_minus; rest != 0u; rest &= rest - 1u) {
        int i = findLSB(rest);
        sum += ((u_plus >> i & 1u) != 0u ? 1.0 : -1.0) * texelFetch(u_film, ivec3(pixel, i), 0);
    }
    vec4 mean = sum / n_samples(pixel);
    if (u_divisor >= 0) {
        vec3 color = texelFetch(u_film, ivec3(pixel, u_divisor), 0).rgb;
        mean.rgb = mix(sum.rgb / max(color, 1e-30), vec3(0.0), equal(color, vec3(0.0)));
    }
    imageStore(u_mean, pixel, mean);
}
