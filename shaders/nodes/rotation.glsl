// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Mapping and the Vector Rotate node. Rotations are three columns, which the host computes if it can.

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

// v rotated about the unit vector `about` by an angle [rad]; as it is about 0.
vec3 rotated_about(vec3 v, vec3 about, float angle)
{
    float s = math_sine(angle), c = math_cosine(angle);
    return about == vec3(0.0) ? v : c * v + s * cross(about, v) + (1.0 - c) * dot(about, v) * about;
}

// Columns of the rotation about an axis of any length.
vec3 axis_angle_x(vec3 axis, float angle)
{
    return rotated_about(vec3(1.0, 0.0, 0.0), unit_of(axis), angle);
}

vec3 axis_angle_y(vec3 axis, float angle)
{
    return rotated_about(vec3(0.0, 1.0, 0.0), unit_of(axis), angle);
}

vec3 axis_angle_z(vec3 axis, float angle)
{
    return rotated_about(vec3(0.0, 0.0, 1.0), unit_of(axis), angle);
}

vec3 rotated(vec3 v, vec3 center, vec3 x, vec3 y, vec3 z)
{
    return bounded3(mat3(x, y, z) * (v - center) + center);
}

vec3 rotated_back(vec3 v, vec3 center, vec3 x, vec3 y, vec3 z)
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
