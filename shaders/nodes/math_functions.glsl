// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the operations of the Math node that are functions of analysis.

#include "nodes/bounded.glsl"

// The angle within half a turn of 0: far from there, sines of graphics cards are wrong.
float angle_near_zero(float x)
{
    float turns = round(x * 0.15915494);
    precise float near = (x - turns * 6.28125) - turns * 0.0019353072;
    return abs(near) < 3.2 ? near : 0.0;
}

// 0 where there is none: of negative numbers only whole powers.
float math_power(float a, float b)
{
    if (b == 0.0)
        return 1.0;
    if (a == 0.0)
        return b > 0.0 ? 0.0 : LARGEST;
    float power = bounded(pow(abs(a), b));
    if (a > 0.0)
        return power;
    bool is_odd = abs(b) < 16777216.0 && floor(b * 0.5) * 2.0 != b;
    return floor(b) != b ? 0.0 : is_odd ? -power : power;
}

float math_logarithm(float a, float base)
{
    return a > 0.0 && base > 0.0 ? divided(log(a), log(base)) : 0.0;
}

float math_square_root(float a)
{
    return sqrt(max(a, 0.0));
}

float math_inverse_square_root(float a)
{
    return a > 0.0 ? bounded(inversesqrt(a)) : 0.0;
}

float math_exponent(float a)
{
    return bounded(exp(clamp(a, -88.7, 88.7)));
}

float math_sine(float a)
{
    return sin(angle_near_zero(a));
}

float math_cosine(float a)
{
    return cos(angle_near_zero(a));
}

float math_tangent(float a)
{
    float x = angle_near_zero(a);
    return divided(sin(x), cos(x));
}

float math_arcsine(float a)
{
    float x = clamp(a, -1.0, 1.0);
    return atan(x, sqrt((1.0 - x) * (1.0 + x)));
}

float math_arccosine(float a)
{
    float x = clamp(a, -1.0, 1.0);
    return 2.0 * atan(sqrt(1.0 - x), sqrt(1.0 + x));
}

float math_arctangent(float a)
{
    return atan(a);
}

float math_arctangent2(float y, float x)
{
    return x == 0.0 && y == 0.0 ? 0.0 : atan(y, x);
}

float math_hyperbolic_sine(float a)
{
    float x = clamp(a, -88.7, 88.7);
    float series = x * (1.0 + x * x / 6.0 * (1.0 + x * x / 20.0));
    return abs(x) < 0.5 ? series : bounded(0.5 * exp(x) - 0.5 * exp(-x));
}

float math_hyperbolic_cosine(float a)
{
    float x = clamp(a, -88.7, 88.7);
    return bounded(0.5 * exp(x) + 0.5 * exp(-x));
}

float math_hyperbolic_tangent(float a)
{
    float t = exp(-2.0 * min(abs(a), 20.0));
    return sign(a) * (1.0 - t) / (1.0 + t);
}

// A sigmoid around `center`.
float squeezed(float a, float width, float center)
{
    return divided(1.0, 1.0 + math_exponent(bounded((center - a) * width)));
}
