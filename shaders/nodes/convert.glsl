// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what links between sockets of different types do, and weights of mixtures.

#include "nodes/bounded.glsl"

const vec3 LUMINANCE = vec3(0.2126391, 0.7151691, 0.0721928);  // of Rec. 709; digits as in Cycles, white is 1.000001

float number_of_color(vec3 c)
{
    return bounded(dot(c, LUMINANCE));
}

float number_of_vector(vec3 v)
{
    return bounded((v.x + v.y + v.z) / 3.0);
}

vec3 splat(float x)
{
    return vec3(x);
}

int number_as_int(float x)
{
    return int(x);
}

float int_as_number(int i)
{
    return float(i);
}

bool number_as_bool(float x)
{
    return x != 0.0;
}

float bool_as_number(bool b)
{
    return b ? 1.0 : 0.0;
}

vec3 widened(vec2 v)
{
    return vec3(v, 0.0);
}

vec3 narrowed(vec4 v)
{
    return v.xyz;
}

float share_of_first(float x)
{
    return 1.0 - clamp(x, 0.0, 1.0);
}

float share_of_second(float x)
{
    return clamp(x, 0.0, 1.0);
}

float product_of_weights(float a, float b)
{
    return a * b;
}

float sum_of_weights(float a, float b)
{
    return a + b;
}
