// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    how noisy each tile of 8 by 8 pixels still is: half of the samples against all of them [Dammertz10b].
// Formula:    e = |I - A|_1 / sqrt(|I|_1), I the mean of all samples, A of half of them; the root of the mean
//             of e^2 over the tile
// In:         u_film
// Out:        Errors: e of each tile; one invocation adds up, in the order of pixels
// Invocation: one pixel; a workgroup is a tile

#include "bind/film.glsl"
#include "bind/samples.glsl"

const float BLACK = 1e-4;  // keeps the quotient finite where there is no light

const float OUTSIDE = -1.0;
const float NEVER_QUIET = 1e30;

layout(local_size_x = 64) in;

layout(std430) buffer Errors { float errors[]; };
uniform sampler2DArray u_film;

uniform uint u_first;
uniform uint u_end;
uniform ivec2 u_size;

shared float squares[64];

// By its bits: compilers may take it that comparisons meet no NaN.
bool is_finite(float x)
{
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}

float squared_error(ivec2 pixel)
{
    vec3 I = texelFetch(u_film, ivec3(pixel, u_planes[COMBINED]), 0).rgb / n_samples(pixel);
    vec3 A = texelFetch(u_film, ivec3(pixel, u_planes[HALF]), 0).rgb * 2.0 / n_samples(pixel);
    vec3 difference = abs(I - A);
    float e = (difference.r + difference.g + difference.b) / (BLACK + sqrt(max(I.r + I.g + I.b, 0.0)));
    return is_finite(e) ? e * e : NEVER_QUIET;
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    bool is_inside = index < u_end && all(lessThan(pixel, u_size));
    squares[gl_LocalInvocationIndex] = is_inside ? squared_error(pixel) : OUTSIDE;
    barrier();
    if (gl_LocalInvocationIndex != 0u || index >= u_end)
        return;
    float sum = 0.0, n = 0.0;
    for (int i = 0; i < 64; i++)
        if (squares[i] != OUTSIDE)
            sum += squares[i], n += 1.0;
    errors[index / 64u] = sqrt(sum / max(n, 1.0));
}
