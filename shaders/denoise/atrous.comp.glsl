// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one pass of the edge-avoiding a-trous wavelet [Dammertz10], guided by variance [Schied17]: where the light is
//             known well, nothing is smoothed, so that the picture converges to the unfiltered one.
// Formula:    w = h |n.n'|^64 exp(-|plane distance| / z) exp(-|dY| / (k sigma)); variances add with w^2
// In:         u_light_in (rgb light, a variance or -1), u_film (normals, depths)
// Out:        u_light
// Invocation: one pixel

#include "bind/camera.glsl"
#include "lib/layouts.glsl"
#include "lib/math.glsl"

const float NORMAL_POWER = 64.0;
const float PLANE_PIXELS = 1.0;    // z: distance from the surface's plane, in pixels of that depth

layout(local_size_x = 64) in;

layout(rgba32f) uniform writeonly image2D u_light;
uniform sampler2D u_light_in;
uniform sampler2DArray u_film;

uniform uint u_first;
uniform uint u_end;
uniform int u_step;                // pixels between taps
uniform float u_sigmas;            // k: differences of so many standard deviations are noise

float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

// Mean normal and mean position of a pixel's surface.
void guide(ivec2 pixel, out vec3 n, out vec3 p, out float depth)
{
    vec4 sums = texelFetch(u_film, ivec3(pixel, PLANE_NORMAL_DEPTH), 0);
    float count = max(texelFetch(u_film, ivec3(pixel, PLANE_DIFFUSE_COLOR), 0).a, 1.0);
    vec3 o, d;
    camera_ray(vec2(pixel) + 0.5, o, d);
    n = sums.xyz / count;
    depth = sums.a / count;
    p = o + d * depth;
}

// The variance that steers is itself noisy: its mean over 3x3 pixels.
float steady_variance(ivec2 pixel)
{
    float sum = 0.0, weight = 0.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            float variance = texelFetch(u_light_in, clamp(pixel + ivec2(x, y), ivec2(0), u_size - 1), 0).a;
            float w = variance < 0.0 ? 0.0 : (2.0 - abs(float(x))) * (2.0 - abs(float(y)));
            sum += w * variance, weight += w;
        }
    return sum / max(weight, 1e-6);
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
    vec3 n, p, other_n, other_p, o, d, o1, d1;
    float depth, other_depth;
    guide(pixel, n, p, depth);
    camera_ray(vec2(pixel) + vec2(1.5, 0.5), o1, d1);
    camera_ray(vec2(pixel) + 0.5, o, d);
    float pixel_size = distance(o + d * depth, o1 + d1 * depth) * PLANE_PIXELS * float(u_step) + 1e-9;
    float sigma = u_sigmas * sqrt(steady_variance(pixel)) + 1e-9, Y = luminance(own.rgb);
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
            guide(at, other_n, other_p, other_depth);
            float w = kernel[abs(x)] * kernel[abs(y)] * pow(clamp(dot(n, other_n), 0.0, 1.0), NORMAL_POWER)
                    * exp(-abs(dot(n, other_p - p)) / pixel_size - abs(luminance(tap.rgb) - Y) / sigma);
            sum += vec4(w * tap.rgb, w * w * tap.a);
            weight += w;
        }
    imageStore(u_light, pixel, weight > 1e-6 ? vec4(sum.rgb / weight, sum.a / (weight * weight)) : own);
}
