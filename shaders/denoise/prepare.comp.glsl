// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the mean light of one plane of the film without the surface's colour, and the variance of that mean.
// Formula:    E = s sum(L) / sum(rho), s = pi for irradiance; var = (sum(Y^2) / n - Y^2) / (n - 1), with few samples
//             estimated from the pixels around
// In:         u_film
// Out:        u_light: rgb E, a variance of its luminance; negative where there is no such surface
// Invocation: one pixel

#include "bind/film.glsl"
#include "bind/samples.glsl"

uniform int u_plane;     // layer of light
uniform int u_color;     // of the albedo that it was multiplied with
uniform float u_scale;   // s
const float FEW = 4.0;      // samples below which a pixel alone does not tell its variance
const int RADIUS = 3;

layout(local_size_x = 64) in;

layout(rgba32f) uniform writeonly image2D u_light;
uniform sampler2DArray u_film;

uniform uint u_first;
uniform uint u_end;
uniform ivec2 u_size;

vec3 light(ivec2 pixel, vec3 color)
{
    return u_scale * texelFetch(u_film, ivec3(pixel, u_plane), 0).rgb / max(color, MIN_ALBEDO * n_samples(pixel));
}

// Variance of one sample, from second differences along the rows around, which light that changes evenly does not have:
// those of noise have the variance 1 + 4 + 1.
float spatial_variance(ivec2 pixel)
{
    vec3 n = normalize(texelFetch(u_film, ivec3(pixel, u_planes[NORMAL_DEPTH]), 0).xyz + 1e-9);
    float squares = 0.0, weight = 0.0;
    for (int y = -RADIUS; y <= RADIUS; y++) {
        vec3 Y = vec3(0.0), w = vec3(0.0);  // of three neighbours
        for (int x = -RADIUS; x <= RADIUS; x++) {
            ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), u_size - 1);
            vec3 other = normalize(texelFetch(u_film, ivec3(at, u_planes[NORMAL_DEPTH]), 0).xyz + 1e-9);
            bool has_surface = texelFetch(u_film, ivec3(at, u_planes[DIFFUSE_COLOR]), 0).a > 0.0;
            Y = vec3(Y.yz, luminance(light(at, texelFetch(u_film, ivec3(at, u_color), 0).rgb)));
            w = vec3(w.yz, has_surface ? pow(max(dot(n, other), 0.0), 32.0) : 0.0);
            float bend = Y.x - 2.0 * Y.y + Y.z, together = w.x * w.y * w.z;
            squares += together * bend * bend / 6.0;
            weight += together;
        }
    }
    return squares / max(weight, 1e-6);
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    vec3 color = texelFetch(u_film, ivec3(pixel, u_color), 0).rgb;
    float n = texelFetch(u_film, ivec3(pixel, u_planes[DIFFUSE_COLOR]), 0).a;
    if (max(color.r, max(color.g, color.b)) <= 1e-3 * n) {
        imageStore(u_light, pixel, vec4(0.0, 0.0, 0.0, -1.0));
        return;
    }
    vec3 E = light(pixel, color);
    float Y = luminance(E), variance;
    if (n_samples(pixel) < FEW)
        variance = spatial_variance(pixel);
    else
        variance = max(texelFetch(u_film, ivec3(pixel, u_plane), 0).a / n - Y * Y, 0.0) / max(n - 1.0, 1.0);
    imageStore(u_light, pixel, vec4(E, variance));
}
