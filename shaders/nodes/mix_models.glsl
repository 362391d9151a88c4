// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the blend modes of the Mix node that take hue, saturation or value from one colour to another.

#include "nodes/color_models.glsl"
#include "nodes/mix.glsl"

vec3 mix_hue(float t, vec3 a, vec3 b)
{
    vec3 other = hsv_of_rgb(b);
    return other.y == 0.0 ? a : mix_blend(t, a, rgb_of_hsv(vec3(other.x, hsv_of_rgb(a).yz)));
}

vec3 mix_saturation(float t, vec3 a, vec3 b)
{
    vec3 own = hsv_of_rgb(a);
    float saturation = mix_number(t, own.y, hsv_of_rgb(b).y);
    return own.y == 0.0 ? a : rgb_of_hsv(vec3(own.x, saturation, own.z));
}

vec3 mix_value(float t, vec3 a, vec3 b)
{
    vec3 own = hsv_of_rgb(a);
    return rgb_of_hsv(vec3(own.xy, mix_number(t, own.z, hsv_of_rgb(b).z)));
}

vec3 mix_color(float t, vec3 a, vec3 b)
{
    vec3 other = hsv_of_rgb(b);
    return other.y == 0.0 ? a : mix_blend(t, a, rgb_of_hsv(vec3(other.xy, hsv_of_rgb(a).z)));
}
