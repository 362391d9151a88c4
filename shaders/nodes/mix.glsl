// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Mix node for numbers and vectors, and its plain blend modes for colours, which is those of single parts.

#include "nodes/bounded.glsl"

float mix_number(float t, float a, float b)
{
    return bounded(a * (1.0 - t) + b * t);
}

vec3 mix_vector(float t, vec3 a, vec3 b)
{
    return bounded3(a * (1.0 - t) + b * t);
}

vec3 mix_vector_by_parts(vec3 t, vec3 a, vec3 b)
{
    return bounded3(a * (1.0 - t) + b * t);
}

vec3 factors_clamped(vec3 t)
{
    return clamp(t, 0.0, 1.0);
}

vec3 color_clamped(vec3 c)
{
    return clamp(c, 0.0, 1.0);
}

vec3 mix_blend(float t, vec3 a, vec3 b)
{
    return bounded3(a + t * (b - a));
}

vec3 mix_add(float t, vec3 a, vec3 b)
{
    return bounded3(a + t * b);
}

vec3 mix_subtract(float t, vec3 a, vec3 b)
{
    return bounded3(a - t * b);
}

vec3 mix_multiply(float t, vec3 a, vec3 b)
{
    return bounded3(a * (1.0 - t + t * b));
}

// Parts over 0 stay what they are.
vec3 mix_divide(float t, vec3 a, vec3 b)
{
    return mix(bounded3((1.0 - t) * a + t * divided3(a, b)), a, equal(b, vec3(0.0)));
}

vec3 mix_screen(float t, vec3 a, vec3 b)
{
    return bounded3(1.0 - (1.0 - t + t * (1.0 - b)) * (1.0 - a));
}

vec3 mix_difference(float t, vec3 a, vec3 b)
{
    return mix_blend(t, a, abs(a - b));
}

vec3 mix_exclusion(float t, vec3 a, vec3 b)
{
    return max(mix_blend(t, a, bounded3(a + b - 2.0 * a * b)), 0.0);
}

vec3 mix_darken(float t, vec3 a, vec3 b)
{
    return mix_blend(t, a, min(a, b));
}

vec3 mix_lighten(float t, vec3 a, vec3 b)
{
    return mix_blend(t, a, max(a, b));
}

vec3 mix_overlay(float t, vec3 a, vec3 b)
{
    vec3 dark = a * (1.0 - t + 2.0 * t * b), bright = 1.0 - (1.0 - t + 2.0 * t * (1.0 - b)) * (1.0 - a);
    return bounded3(mix(bright, dark, lessThan(a, vec3(0.5))));
}

vec3 mix_soft_light(float t, vec3 a, vec3 b)
{
    vec3 screen = 1.0 - (1.0 - b) * (1.0 - a);
    return bounded3((1.0 - t) * a + t * ((1.0 - a) * b * a + a * screen));
}

vec3 mix_linear_light(float t, vec3 a, vec3 b)
{
    return bounded3(a + t * (2.0 * b - 1.0));
}

float dodged(float t, float a, float b)
{
    float rest = 1.0 - t * b;
    return a == 0.0 ? 0.0 : rest <= 0.0 ? 1.0 : min(divided(a, rest), 1.0);
}

vec3 mix_dodge(float t, vec3 a, vec3 b)
{
    return vec3(dodged(t, a.x, b.x), dodged(t, a.y, b.y), dodged(t, a.z, b.z));
}

float burnt(float t, float a, float b)
{
    float rest = 1.0 - t + t * b;
    return rest <= 0.0 ? 0.0 : clamp(1.0 - divided(1.0 - a, rest), 0.0, 1.0);
}

vec3 mix_burn(float t, vec3 a, vec3 b)
{
    return vec3(burnt(t, a.x, b.x), burnt(t, a.y, b.y), burnt(t, a.z, b.z));
}
