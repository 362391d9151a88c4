// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: directions towards a triangle: uniform in the solid angle that it fills where it is near, so that light does not
// grow without bound there, and uniform in its area where the solid angle is too small for single precision.

#include "lib/math.glsl"

const float NEAR = 1e-3;  // solid angle [sr] from which a triangle is near

struct TriangleDraw {
    vec3 wi;            // unit
    float distance;     // metres
    vec2 bary;          // of the second and third corner
    float solid_angle;  // [sr], one over the density of wi
};

// The part of v that is square to the unit vector n, v a unit vector near n or far from it.
vec3 tangent_part(vec3 n, vec3 v)
{
    vec3 off = v - n;
    return off + 0.5 * dot(off, off) * n;
}

// Of the triangle between three unit vectors [VanOosterom83].
float solid_angle_of(vec3 a, vec3 b, vec3 c)
{
    float volume = abs(dot(a, cross(b - a, c - a)));
    float angle = 2.0 * atan(volume, 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
    return angle < 0.0 ? angle + 2.0 * PI : angle;
}

// Uniform in the spherical triangle between three unit vectors, of solid angle omega [Arvo95]; its differences of nearly
// equal numbers are rewritten as products.
vec3 spherical_triangle_direction(vec3 a, vec3 b, vec3 c, float omega, vec2 u)
{
    vec3 to_b = tangent_part(a, b), to_c = normalize(tangent_part(a, c));
    vec3 normal_b = normalize(to_b);
    float cos_alpha = clamp(dot(normal_b, to_c), -1.0, 1.0), sin_alpha = max(length(cross(normal_b, to_c)), 1e-9);
    float part = omega * u.x, alpha = atan(sin_alpha, cos_alpha);
    float s = sin(part - alpha), t = cos(part - alpha);
    float p = 2.0 * sin(alpha - 0.5 * part) * sin(0.5 * part);
    float q = 2.0 * sin(0.5 * part) * cos(0.5 * part - alpha) - sin_alpha * 0.5 * dot(b - a, b - a);
    float below = (q * s + p * t) * sin_alpha;
    float cosine = abs(below) > 1e-20 ? clamp(((q * t - p * s) * cos_alpha - q) / below, -1.0, 1.0) : 1.0;
    vec3 on_ac = cosine * a + sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0)) * to_c;
    float fall = u.y * 0.5 * dot(on_ac - b, on_ac - b);
    vec3 towards = tangent_part(b, on_ac);
    float size = length(towards);
    return normalize((1.0 - fall) * b + (size > 1e-12 ? sqrt(max(fall * (2.0 - fall), 0.0)) / size : 0.0) * towards);
}

// Solid angle over which directions to the triangle are spread around d: corners relative to the eye, d unit.
float spread_towards(mat3 corners, vec3 d)
{
    float omega = solid_angle_of(normalize(corners[0]), normalize(corners[1]), normalize(corners[2]));
    if (omega >= NEAR)
        return omega;
    vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
    float cosine = dot(d, n), distance = dot(corners[0], n) / cosine;  // cosine: times twice the area
    return cosine != 0.0 && distance != 0.0 ? 0.5 * abs(cosine) / (distance * distance) : 0.0;
}

TriangleDraw draw_triangle(mat3 corners, vec2 u)
{
    vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0], n = cross(ab, ac);
    vec3 a = normalize(corners[0]), b = normalize(corners[1]), c = normalize(corners[2]);
    float omega = solid_angle_of(a, b, c);
    if (omega >= NEAR) {
        vec3 wi = spherical_triangle_direction(a, b, c, omega, u);
        float distance = dot(corners[0], n) / dot(wi, n);
        vec3 off = wi * distance - corners[0];
        vec2 bary = vec2(dot(cross(off, ac), n), dot(cross(ab, off), n)) / dot(n, n);
        return TriangleDraw(wi, distance, bary, omega);
    }
    float root = sqrt(u.x);
    vec2 bary = vec2(root * (1.0 - u.y), root * u.y);
    vec3 to_point = corners[0] + bary.x * ab + bary.y * ac;
    float d2 = max(dot(to_point, to_point), 1e-20);
    vec3 wi = to_point * inversesqrt(d2);
    return TriangleDraw(wi, sqrt(d2), bary, 0.5 * abs(dot(wi, n)) / d2);
}
