// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: Image Texture and Environment Texture: projections, and the filters that images can be read with.

#include "bind/attributes.glsl"
#include "bind/textures.glsl"

struct ImageSample {
    vec3 color;
    float alpha;
};

// Weights of four texels in a row for cubic B-splines, t between the second and the third.
vec4 spline_weights(float t)
{
    float s = 1.0 - t;
    return vec4(s * s * s, 4.0 + 3.0 * t * t * (t - 2.0), 4.0 + 3.0 * s * s * (s - 2.0), t * t * t) / 6.0;
}

vec4 picture_cubic(uint row, vec2 uv, uint extension, bool divides)
{
    Picture p = picture_at(row, uv);
    vec2 at = uv * vec2(p.width, p.height) - 0.5;
    if (!all(lessThan(abs(at), vec2(2e9))))
        return vec4(0.0);
    if (p.n_tiles == 0u)
        return MISSING;
    vec2 low = floor(at);
    vec4 wx = spline_weights(at.x - low.x), wy = spline_weights(at.y - low.y), sum = vec4(0.0);
    for (int i = 0, n = p.n_tiles > 0u ? 16 : 0; i < n; i++)
        sum += wx[i & 3] * wy[i >> 2] * texel(p, ivec2(low) + ivec2(i & 3, i >> 2) - 1, extension);
    return meant(p, sum, divides);
}

// filtering: 0 for the closest texel, 1 linear, 2 cubic.
vec4 picture_filtered(uint row, vec2 uv, uint extension, int filtering, bool divides)
{
    return filtering == 2 ? picture_cubic(row, uv, extension, divides)
                          : picture_color(row, uv, extension, filtering == 0, divides);
}

ImageSample image_flat(vec3 at, uint row, uint extension, int filtering, bool divides)
{
    vec4 c = picture_filtered(row, at.xy, extension, filtering, divides);
    return ImageSample(c.rgb, c.a);
}

ImageSample image_missing()
{
    return ImageSample(MISSING.rgb, MISSING.a);
}

// How much each of the three sides of a box shows at a normal whose parts are positive and add up to one. Sides meet
// where their parts are alike; `blend` widens that.
vec3 box_weights(vec3 n, float blend)
{
    float limit = 0.5 * (1.0 + blend);
    if (n.x > limit * (n.x + n.y) && n.x > limit * (n.x + n.z))
        return vec3(1.0, 0.0, 0.0);
    if (n.y > limit * (n.x + n.y) && n.y > limit * (n.y + n.z))
        return vec3(0.0, 1.0, 0.0);
    if (n.z > limit * (n.x + n.z) && n.z > limit * (n.y + n.z))
        return vec3(0.0, 0.0, 1.0);
    if (blend <= 0.0)
        return vec3(1.0, 0.0, 0.0);
    float middle = 0.5 * (1.0 - blend);
    if (n.z < (1.0 - limit) * (n.y + n.x)) {
        float w = clamp((n.x / (n.x + n.y) - middle) / blend, 0.0, 1.0);
        return vec3(w, 1.0 - w, 0.0);
    }
    if (n.x < (1.0 - limit) * (n.y + n.z)) {
        float w = clamp((n.y / (n.y + n.z) - middle) / blend, 0.0, 1.0);
        return vec3(0.0, w, 1.0 - w);
    }
    if (n.y < (1.0 - limit) * (n.x + n.z)) {
        float w = clamp((n.x / (n.x + n.z) - middle) / blend, 0.0, 1.0);
        return vec3(w, 0.0, 1.0 - w);
    }
    return ((2.0 - limit) * n + (limit - 1.0)) / (2.0 * limit - 1.0);
}

ImageSample image_box(Geo g, vec3 at, uint row, uint extension, int filtering, bool divides, float blend)
{
    vec3 n = normal_to_object(g, g.normal), w = abs(n);
    w = box_weights(w / max(w.x + w.y + w.z, 1e-20), blend);
    vec2 uv[3] = vec2[3](vec2(n.x < 0.0 ? 1.0 - at.y : at.y, at.z), vec2(n.y > 0.0 ? 1.0 - at.x : at.x, at.z),
                         vec2(n.z > 0.0 ? 1.0 - at.y : at.y, at.x));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 3; i++)
        if (w[i] > 0.0)
            sum += w[i] * picture_filtered(row, uv[i], extension, filtering, divides);
    return ImageSample(sum.rgb, sum.a);
}

ImageSample image_sphere(vec3 at, uint row, uint extension, int filtering, bool divides)
{
    vec3 p = 2.0 * at - 1.0;
    float l = length(p), u = p.x == 0.0 && p.y == 0.0 ? 0.0 : 0.5 - atan(p.x, p.y) / (2.0 * PI);
    vec2 uv = l > 0.0 ? vec2(u, 1.0 - acos(clamp(p.z / l, -1.0, 1.0)) / PI) : vec2(0.0);
    return image_flat(vec3(uv, 0.0), row, extension, filtering, divides);
}

ImageSample image_tube(vec3 at, uint row, uint extension, int filtering, bool divides)
{
    vec3 p = 2.0 * at - 1.0;
    vec2 uv = dot(p.xy, p.xy) > 0.0 ? vec2(0.5 - atan(p.x, p.y) / (2.0 * PI), 0.5 * (p.z + 1.0)) : vec2(0.0);
    return image_flat(vec3(uv, 0.0), row, extension, filtering, divides);
}

// Around a direction of any length; upwards is +z.
vec3 image_equirectangular(vec3 direction, uint row, int filtering)
{
    vec3 d = unit_or_zero(direction);
    vec2 uv = d == vec3(0.0) ? vec2(0.0)
            : vec2(0.5 - (d.x == 0.0 && d.y == 0.0 ? 0.0 : atan(d.y, d.x)) / (2.0 * PI), 1.0 - acos(clamp(d.z, -1.0, 1.0)) / PI);
    return picture_filtered(row, uv, EXTENSION_REPEAT, filtering, false).rgb;
}

vec3 image_mirror_ball(vec3 direction, uint row, int filtering)
{
    vec3 d = unit_or_zero(direction);
    d.y -= 1.0;
    float l = 2.0 * sqrt(max(-0.5 * d.y, 0.0));
    d = l > 0.0 ? d / l : d;
    return picture_filtered(row, 0.5 * (d.xz + 1.0), EXTENSION_REPEAT, filtering, false).rgb;
}
