// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Mapping and the Vector Rotate node. Euler's rotations are three columns, which the host computes if it can.

#include "nodes/math_functions.glsl"

// Columns of the rotation about x, then y, then z by the angles r [rad].
vec3 euler_x(vec3 r)
{
    return vec3(math_cosine(r.y) * math_cosine(r.z), math_cosine(r.y) * math_sine(r.z), -math_sine(r.y));
}

vec3 euler_y(vec3 r)
{
    float sx = math_sine(r.x), cx = math_cosine(r.x), sy = math_sine(r.y), sz = math_sine(r.z), cz = math_cosine(r.z);
    return vec3(sx * sy * cz - cx * sz, sx * sy * sz + cx * cz, sx * math_cosine(r.y));
}

vec3 euler_z(vec3 r)
{
    float sx = math_sine(r.x), cx = math_cosine(r.x), sy = math_sine(r.y), sz = math_sine(r.z), cz = math_cosine(r.z);
    return vec3(cx * sy * cz + sx * sz, cx * sy * sz - sx * cz, cx * math_cosine(r.y));
}

// By an angle [rad] about an axis of any length; as it is about none.
vec3 rotated_by_angle(vec3 v, vec3 center, vec3 axis, float angle)
{
    vec3 about = unit_of(axis), from = v - center;
    float s = math_sine(angle), c = math_cosine(angle);
    vec3 turned = c * from + s * cross(about, from) + (1.0 - c) * dot(about, from) * about;
    return about == vec3(0.0) ? v : bounded3(turned + center);
}

vec3 rotated_by_columns(vec3 v, vec3 center, vec3 x, vec3 y, vec3 z)
{
    return bounded3(mat3(x, y, z) * (v - center) + center);
}

vec3 rotated_back_by_columns(vec3 v, vec3 center, vec3 x, vec3 y, vec3 z)
{
    return bounded3((v - center) * mat3(x, y, z) + center);
}

vec3 mapping_point(vec3 v, vec3 location, vec3 scale, vec3 x, vec3 y, vec3 z)
{
    return bounded3(mat3(x, y, z) * bounded3(v * scale) + location);
}

// The inverse of a point's.
vec3 mapping_texture(vec3 v, vec3 location, vec3 scale, vec3 x, vec3 y, vec3 z)
{
    return divided3(bounded3((v - location) * mat3(x, y, z)), scale);
}

vec3 mapping_vector(vec3 v, vec3 scale, vec3 x, vec3 y, vec3 z)
{
    return bounded3(mat3(x, y, z) * bounded3(v * scale));
}

vec3 mapping_normal(vec3 v, vec3 scale, vec3 x, vec3 y, vec3 z)
{
    return unit_of(bounded3(mat3(x, y, z) * unit_of(divided3(v, scale))));
}
