// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the operations of the Vector Math node on all components alike, and its products.

#include "nodes/bounded.glsl"

vec3 vector_add(vec3 a, vec3 b)
{
    return bounded3(a + b);
}

vec3 vector_subtract(vec3 a, vec3 b)
{
    return bounded3(a - b);
}

vec3 vector_multiply(vec3 a, vec3 b)
{
    return bounded3(a * b);
}

vec3 vector_divide(vec3 a, vec3 b)
{
    return divided3(a, b);
}

vec3 vector_multiply_add(vec3 a, vec3 b, vec3 c)
{
    return bounded3(a * b + c);
}

vec3 vector_scale(vec3 a, float scale)
{
    return bounded3(a * scale);
}

vec3 vector_absolute(vec3 a)
{
    return abs(a);
}

vec3 vector_sign(vec3 a)
{
    return sign(a);
}

vec3 vector_minimum(vec3 a, vec3 b)
{
    return min(a, b);
}

vec3 vector_maximum(vec3 a, vec3 b)
{
    return max(a, b);
}

vec3 vector_floor(vec3 a)
{
    return floor(a);
}

vec3 vector_ceil(vec3 a)
{
    return ceil(a);
}

vec3 vector_fraction(vec3 a)
{
    return a - floor(a);
}

vec3 vector_snap(vec3 a, vec3 b)
{
    return bounded3(floor(divided3(a, b)) * b);
}

float vector_dot(vec3 a, vec3 b)
{
    return bounded(dot(a, b));
}

vec3 vector_cross(vec3 a, vec3 b)
{
    return bounded3(cross(a, b));
}

float vector_length(vec3 a)
{
    return length_of(a);
}

float vector_distance(vec3 a, vec3 b)
{
    return length_of(bounded3(a - b));
}

vec3 vector_normalize(vec3 a)
{
    return unit_of(a);
}
