// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the operations of the Math node that are arithmetic and comparisons.

#include "nodes/bounded.glsl"

float math_add(float a, float b)
{
    return bounded(a + b);
}

float math_subtract(float a, float b)
{
    return bounded(a - b);
}

float math_multiply(float a, float b)
{
    return bounded(a * b);
}

float math_divide(float a, float b)
{
    return divided(a, b);
}

float math_multiply_add(float a, float b, float c)
{
    return bounded(a * b + c);
}

float math_absolute(float a)
{
    return abs(a);
}

float math_sign(float a)
{
    return sign(a);
}

float math_minimum(float a, float b)
{
    return min(a, b);
}

float math_maximum(float a, float b)
{
    return max(a, b);
}

float math_less_than(float a, float b)
{
    return a < b ? 1.0 : 0.0;
}

float math_greater_than(float a, float b)
{
    return a > b ? 1.0 : 0.0;
}

// 1 where a and b are equal, or nearer than c.
float math_compare(float a, float b, float c)
{
    return a == b || abs(a - b) <= max(c, 1.1920929e-7) ? 1.0 : 0.0;
}

// A cubic fillet in the corner between a and b, from where they are k apart.
float math_smooth_minimum(float a, float b, float k)
{
    float h = divided(max(k - abs(a - b), 0.0), k);
    return bounded(min(a, b) - h * h * h * k / 6.0);
}

float math_smooth_maximum(float a, float b, float k)
{
    return -math_smooth_minimum(-a, -b, k);
}

float math_clamped(float a)
{
    return clamp(a, 0.0, 1.0);
}

float math_radians(float a)
{
    return a * 0.017453292;
}

float math_degrees(float a)
{
    return bounded(a * 57.29578);
}
