// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the operations of the Vector Math node that are functions of each component by itself.

#include "nodes/math_rounding.glsl"
#include "nodes/math_functions.glsl"

vec3 vector_modulo(vec3 a, vec3 b)
{
    return vec3(math_modulo(a.x, b.x), math_modulo(a.y, b.y), math_modulo(a.z, b.z));
}

vec3 vector_wrap(vec3 a, vec3 high, vec3 low)
{
    return vec3(math_wrap(a.x, high.x, low.x), math_wrap(a.y, high.y, low.y), math_wrap(a.z, high.z, low.z));
}

vec3 vector_power(vec3 a, vec3 b)
{
    return vec3(math_power(a.x, b.x), math_power(a.y, b.y), math_power(a.z, b.z));
}

vec3 vector_sine(vec3 a)
{
    return vec3(math_sine(a.x), math_sine(a.y), math_sine(a.z));
}

vec3 vector_cosine(vec3 a)
{
    return vec3(math_cosine(a.x), math_cosine(a.y), math_cosine(a.z));
}

vec3 vector_tangent(vec3 a)
{
    return vec3(math_tangent(a.x), math_tangent(a.y), math_tangent(a.z));
}
