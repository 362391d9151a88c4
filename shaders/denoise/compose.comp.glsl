// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one plane of the film in the picture replaced by what the filter made of it; or, without a plane, the picture
//             as the film has it.
// Formula:    L = sum(L) / n, then L += (rho F / s - sum(L_plane)) / n; the filter makes no light negative
// In:         u_film; u_light: F, a < 0 where there is none
// Out:        u_picture: premultiplied RGBA
// Invocation: one pixel

#include "bind/film.glsl"
#include "bind/samples.glsl"

uniform int u_plane;     // layer of light; -1: none
uniform int u_color;     // of the albedo that it was multiplied with
uniform float u_scale;   // s

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2D u_picture;
uniform sampler2DArray u_film;
uniform sampler2D u_light;

uniform uint u_first;
uniform uint u_end;
uniform ivec2 u_size;

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    if (u_plane < 0) {
        imageStore(u_picture, pixel, texelFetch(u_film, ivec3(pixel, u_planes[COMBINED]), 0) / n_samples(pixel));
        return;
    }
    vec4 light = texelFetch(u_light, pixel, 0), L = imageLoad(u_picture, pixel);
    if (light.a < 0.0)
        return;
    vec3 change = texelFetch(u_film, ivec3(pixel, u_color), 0).rgb / u_scale * light.rgb - texelFetch(u_film, ivec3(pixel, u_plane), 0).rgb;
    L.rgb = max(L.rgb + change / n_samples(pixel), min(L.rgb, 0.0));
    imageStore(u_picture, pixel, L);
}
