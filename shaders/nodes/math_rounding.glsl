// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the operations of the Math node that round, and repeat.

#include "nodes/bounded.glsl"

float math_round(float a)
{
    return floor(a + 0.5);
}

float math_floor(float a)
{
    return floor(a);
}

float math_ceil(float a)
{
    return ceil(a);
}

float math_truncate(float a)
{
    return trunc(a);
}

float math_fraction(float a)
{
    return a - floor(a);
}

// What is left of a, with its sign. The quotient is rounded, so one b more or less may have been taken off.
float math_modulo(float a, float b)
{
    float x = abs(a), y = abs(b);
    float rest = fma(-y, trunc(divided(x, y)), x);
    rest = rest < 0.0 ? rest + y : rest >= y ? rest - y : rest;
    return b != 0.0 && rest >= 0.0 && rest < y ? (a < 0.0 ? -rest : rest) : 0.0;
}

// The rest with the sign of b.
float math_floored_modulo(float a, float b)
{
    return b != 0.0 ? bounded(a - floor(divided(a, b)) * b) : 0.0;
}

// Repeats a between two bounds.
float math_wrap(float a, float high, float low)
{
    float range = high - low;
    return range != 0.0 ? bounded(a - range * floor(divided(a - low, range))) : low;
}

// The next multiple of b below a.
float math_snap(float a, float b)
{
    return bounded(floor(divided(a, b)) * b);
}

// To b and back again.
float math_pingpong(float a, float b)
{
    float turns = divided(a - b, 2.0 * b);
    return bounded(abs((turns - floor(turns)) * b * 2.0 - b));
}
