// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one plane of the film in the picture replaced by what the filter made of it; or, without a plane, the picture
//             as the film has it.
// Formula:    L = sum(L) / n, then L += (rho F / s - sum(L_plane)) / n; the filter makes no light negative
// In:         u_film; u_light: F, a < 0 where there is none
// Out:        u_picture: premultiplied RGBA
// Invocation: one pixel

#include "bind/film.glsl"
#include "bind/samples.glsl"

const int PLANE = -1;      // of light
const int COLOR = -1;      // of the albedo that it was multiplied with
const float SCALE = 1.0;   // s

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
    if (PLANE < 0) {
        imageStore(u_picture, pixel, texelFetch(u_film, ivec3(pixel, PLANE_COMBINED), 0) / n_samples(pixel));
        return;
    }
    vec4 light = texelFetch(u_light, pixel, 0), L = imageLoad(u_picture, pixel);
    if (light.a < 0.0)
        return;
    vec3 change = texelFetch(u_film, ivec3(pixel, COLOR), 0).rgb / SCALE * light.rgb - texelFetch(u_film, ivec3(pixel, PLANE), 0).rgb;
    L.rgb = max(L.rgb + change / n_samples(pixel), min(L.rgb, 0.0));
    imageStore(u_picture, pixel, L);
}
