// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: colours as hue, saturation and value or lightness, as Cycles has them for any numbers.

#include "nodes/bounded.glsl"

vec3 hsv_of_rgb(vec3 c)
{
    float high = max(c.x, max(c.y, c.z)), range = bounded(high - min(c.x, min(c.y, c.z)));
    float saturation = divided(range, high);
    if (saturation == 0.0)
        return vec3(0.0, 0.0, high);
    vec3 d = divided3(high - c, vec3(range));
    float sixths = c.x == high ? d.z - d.y : c.y == high ? 2.0 + d.x - d.z : 4.0 + d.y - d.x;
    return vec3(sixths / 6.0 + (sixths < 0.0 ? 1.0 : 0.0), saturation, high);
}

vec3 rgb_of_hsv(vec3 hsv)
{
    float sixths = hsv.x == 1.0 ? 0.0 : bounded(hsv.x * 6.0), side = floor(sixths), f = sixths - side;
    float v = hsv.z, p = bounded(v * (1.0 - hsv.y));
    float falling = bounded(v * (1.0 - hsv.y * f)), rising = bounded(v * (1.0 - hsv.y * (1.0 - f)));
    if (hsv.y == 0.0)
        return vec3(v);
    return side == 0.0 ? vec3(v, rising, p) : side == 1.0 ? vec3(falling, v, p) : side == 2.0 ? vec3(p, v, rising) :
           side == 3.0 ? vec3(p, falling, v) : side == 4.0 ? vec3(rising, p, v) : vec3(v, p, falling);
}

vec3 hsl_of_rgb(vec3 c)
{
    float high = max(c.x, max(c.y, c.z)), low = min(c.x, min(c.y, c.z)), range = bounded(high - low);
    float lightness = min(1.0, bounded((high + low) * 0.5));
    if (range == 0.0)
        return vec3(0.0, 0.0, lightness);
    float saturation = divided(range, lightness > 0.5 ? bounded(2.0 - high - low) : bounded(high + low));
    float sixths = c.x == high ? divided(c.y - c.z, range) + (c.y < c.z ? 6.0 : 0.0) :
                   c.y == high ? divided(c.z - c.x, range) + 2.0 : divided(c.x - c.y, range) + 4.0;
    return vec3(sixths / 6.0, saturation, lightness);
}

vec3 rgb_of_hsl(vec3 hsl)
{
    float sixths = bounded(hsl.x * 6.0);
    vec3 tint = vec3(abs(sixths - 3.0) - 1.0, 2.0 - abs(sixths - 2.0), 2.0 - abs(sixths - 4.0));
    float chroma = bounded((1.0 - abs(2.0 * hsl.z - 1.0)) * hsl.y);
    return bounded3((clamp(tint, 0.0, 1.0) - 0.5) * chroma + hsl.z);
}
