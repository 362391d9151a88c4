// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the nodes that adjust one colour.

#include "nodes/color_models.glsl"
#include "nodes/convert.glsl"
#include "nodes/math_functions.glsl"

float luminance_of(vec3 c)
{
    return bounded(dot(c, LUMINANCE));
}

vec3 bright_contrast(vec3 c, float brightness, float contrast)
{
    return max(bounded3(c * (1.0 + contrast) + (brightness - 0.5 * contrast)), 0.0);
}

// Negative parts are left alone.
vec3 color_to_power(vec3 c, float gamma)
{
    vec3 power = vec3(math_power(c.x, gamma), math_power(c.y, gamma), math_power(c.z, gamma));
    return gamma == 0.0 ? vec3(1.0) : mix(c, power, greaterThan(c, vec3(0.0)));
}

vec3 hue_saturation_value(float hue, float saturation, float value, float factor, vec3 c)
{
    vec3 hsv = hsv_of_rgb(c);
    float turned = hsv.x + hue + 0.5;
    hsv = vec3(turned - floor(turned), clamp(hsv.y * saturation, 0.0, 1.0), bounded(hsv.z * value));
    return max(bounded3(factor * rgb_of_hsv(hsv) + (1.0 - factor) * c), 0.0);
}

vec3 inverted(float factor, vec3 c)
{
    return bounded3(factor * (1.0 - c) + (1.0 - factor) * c);
}
