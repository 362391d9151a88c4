// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the picture: the mean of the samples, its diffuse light replaced by the filtered one.
// Formula:    L = (sum L - sum rho E / pi) / n + rho / pi (F(E_lamps) + F(E_indirect))
// In:         u_film; u_direct and u_indirect, filtered irradiance [W m^-2], a < 0 where there is none
// Out:        u_picture: premultiplied RGBA
// Invocation: one pixel

#include "lib/layouts.glsl"
#include "lib/math.glsl"

const bool IS_FILTERED = false;

layout(local_size_x = 64) in;

layout(rgba32f) uniform writeonly image2D u_picture;
uniform sampler2DArray u_film;
uniform sampler2D u_direct;
uniform sampler2D u_indirect;

uniform uint u_first;
uniform uint u_end;
uniform ivec2 u_size;
uniform float u_n_samples;

vec3 plane(ivec2 pixel, uint layer)
{
    return texelFetch(u_film, ivec3(pixel, layer), 0).rgb;
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    vec4 sum = texelFetch(u_film, ivec3(pixel, PLANE_COMBINED), 0);
    if (IS_FILTERED && texelFetch(u_direct, pixel, 0).a >= 0.0) {
        vec3 E = texelFetch(u_direct, pixel, 0).rgb + texelFetch(u_indirect, pixel, 0).rgb;
        sum.rgb += plane(pixel, PLANE_DIFFUSE_COLOR) / PI * E - plane(pixel, PLANE_DIFFUSE_DIRECT)
                 - plane(pixel, PLANE_DIFFUSE_INDIRECT);
    }
    imageStore(u_picture, pixel, vec4(max(sum.rgb, 0.0), sum.a) / u_n_samples);
}
