// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one pass of the edge-avoiding a-trous wavelet [Dammertz10], guided by variance [Schied17]: where the light is
//             known well, nothing is smoothed, so that the picture converges to the unfiltered one. What a surface mirrors
//             is smoothed no farther than its roughness blurs it.
// Formula:    w = h w_n exp(-|plane distance| / z) exp(-|dY| / (k sigma)); variances add with w^2; w_n = |n.n'|^64, for a
//             reflection that the eye sees blurred by the angle a, exp(-(|n - n'|^2 + angle between pixels^2) / a^2)
// In:         u_light_in (rgb light, a variance or -1), u_film (normals, depths, angles a)
// Out:        u_light
// Invocation: one pixel

#include "bind/camera.glsl"
#include "bind/film.glsl"
#include "bind/samples.glsl"

uniform bool u_is_glossy;
const float PLANE_PIXELS = 1.0;    // z: distance from the surface's plane, in pixels of that depth
const float BLUR = 3.0;            // a over alpha: GGX sends 7 of 10 reflections into that angle

layout(local_size_x = 64) in;

layout(rgba32f) uniform writeonly image2D u_light;
uniform sampler2D u_light_in;
uniform sampler2DArray u_film;

uniform uint u_first;
uniform uint u_end;
uniform int u_step;                // pixels between taps
uniform float u_sigmas;            // k with one sample: differences of so many standard deviations are noise

struct Guide {
    vec3 normal;
    vec3 position;
    float depth;
};

// Means over the pixel's samples.
Guide guide(ivec2 pixel)
{
    vec4 sums = texelFetch(u_film, ivec3(pixel, u_planes[NORMAL_DEPTH]), 0);
    float count = max(texelFetch(u_film, ivec3(pixel, u_planes[DIFFUSE_COLOR]), 0).a, 1.0);
    vec3 o, d;
    camera_ray(vec2(pixel) + 0.5, o, d);
    return Guide(sums.xyz / count, o + d * (sums.a / count), sums.a / count);
}

// What steers is itself noisy: means over 3x3 pixels of the variance and of the angle a.
vec2 steady(ivec2 pixel)
{
    vec2 sum = vec2(0.0);
    float weight = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), u_size - 1);
            float variance = texelFetch(u_light_in, at, 0).a;
            if (variance < 0.0)
                continue;
            float w = (2.0 - abs(float(x))) * (2.0 - abs(float(y)));
            sum.x += w * variance;
            if (u_is_glossy)
                sum.y += w * texelFetch(u_film, ivec3(at, u_planes[GLOSSY_COLOR]), 0).a / n_samples(at);
            weight += w;
        }
    return sum / max(weight, 1e-6);
}

float to_the_64(float x)
{
    for (int i = 0; i < 6; i++)
        x *= x;
    return x;
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    vec4 own = texelFetch(u_light_in, pixel, 0);
    if (own.a < 0.0) {
        imageStore(u_light, pixel, own);
        return;
    }
    const float kernel[3] = float[3](3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0);
    Guide here = guide(pixel);
    vec3 o, d, o1, d1;
    camera_ray(vec2(pixel) + vec2(1.5, 0.5), o1, d1);
    camera_ray(vec2(pixel) + 0.5, o, d);
    vec2 steady_here = steady(pixel);
    float pixel_size = distance(o + d * here.depth, o1 + d1 * here.depth) + 1e-9, Y = luminance(own.rgb);
    float sigma = u_sigmas * inversesqrt(n_samples(pixel)) * sqrt(steady_here.x) + 1e-9;
    float angle = u_step * pixel_size / max(here.depth, 1e-9), blur = 1.0 / max(BLUR * BLUR * steady_here.y * steady_here.y, 1e-12);
    vec4 sum = vec4(0.0);
    float weight = 0.0;
    for (int y = -2; y <= 2; y++)
        for (int x = -2; x <= 2; x++) {
            ivec2 at = pixel + ivec2(x, y) * u_step;
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, u_size)))
                continue;
            vec4 tap = texelFetch(u_light_in, at, 0);
            if (tap.a < 0.0)
                continue;
            Guide there = guide(at);
            vec3 dn = there.normal - here.normal;
            float w_n = u_is_glossy ? exp(-(dot(dn, dn) + float(x * x + y * y) * angle * angle) * blur)
                                  : to_the_64(clamp(dot(here.normal, there.normal), 0.0, 1.0));
            float w = kernel[abs(x)] * kernel[abs(y)] * w_n
                    * exp(-abs(dot(here.normal, there.position - here.position)) / (pixel_size * PLANE_PIXELS * float(u_step))
                          - abs(luminance(tap.rgb) - Y) / sigma);
            sum += vec4(w * tap.rgb, w * w * tap.a);
            weight += w;
        }
    imageStore(u_light, pixel, weight > 1e-6 ? vec4(sum.rgb / weight, sum.a / (weight * weight)) : own);
}
