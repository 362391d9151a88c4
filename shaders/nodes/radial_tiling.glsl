// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Radial Tiling node: the plane in segments around 0, bounded by a polygon with round corners, as Cycles
//          has it for whole numbers of sides; the last segment of other numbers is rounded as if it were one of its own.

#include "nodes/bounded.glsl"
#include "nodes/math_functions.glsl"

const float TURN = 6.2831855;

struct RadialTiling {
    vec3 coordinates;
    float id;
    float width;
    float rotation;
};

// Angles from a segment's middle: of the point, of the end of the segment, of the start of its round part
struct Segment {
    float at;
    float end;
    float bevel;
};

// How long the round part's curve is before it runs like a circle.
float spline_of(Segment s, float roundness)
{
    return (1.0 - roundness) * (s.end - s.bevel);
}

// Distance of the polygon through the point over that of the one at 1, both along the middle of the segment.
float distance_of(Segment s, float l, float roundness)
{
    if (abs(s.at) <= s.bevel)
        return l * cos(s.at);
    float center = divided(1.0 - roundness, cos(s.end)), along = center * cos(s.end - abs(s.at));
    return divided(l, along + sqrt(max(along * along + roundness * roundness - center * center, 0.0)));
}

// How far the point is along the side of that polygon.
float parameter_of(Segment s, float l, float roundness)
{
    if (abs(s.at) <= s.bevel)
        return l * sin(s.at);
    float into = abs(s.at) - s.bevel, spline = spline_of(s, roundness), flat_part = l * cos(s.bevel);
    float curve = into < spline ? flat_part * into + 0.5 * (1.0 - flat_part) * divided(into * into, spline)
                                : spline * 0.5 * (flat_part - 1.0) + into;
    return sign(s.at) * (l * sin(s.bevel) + curve);
}

// The largest parameter there.
float largest_parameter(Segment s, float l, float d, float roundness)
{
    float rest = 0.5 * spline_of(s, roundness) + roundness * (s.end - s.bevel);
    float straight = d * math_tangent(s.bevel) + 0.5 * d * spline_of(s, roundness) + rest;
    float flat_part = l * cos(s.bevel);
    float bent = l * sin(s.bevel) + 0.5 * flat_part * spline_of(s, roundness) + rest;
    return mix(straight, bent, clamp(divided(abs(s.at) - s.bevel, s.end - s.bevel), 0.0, 1.0));
}

RadialTiling radial_tiling(vec3 v, float n_sides, float round_share, bool normalized)
{
    float sides = clamp(n_sides, 2.0, 1e6), roundness = clamp(round_share, 0.0, 1.0), step_angle = TURN / sides;
    vec2 p = clamp(v.xy, -1e18, 1e18);
    float l = length_of(vec3(p, 0.0)), angle = math_arctangent2(p.y, p.x) + (p.y < 0.0 ? TURN : 0.0);
    float id = floor(angle / step_angle), end = 0.5 * step_angle, scale = 1.0;
    bool is_last = id >= floor(sides) && sides != floor(sides);
    if (is_last) {
        float whole = end;
        end = 0.5 * (TURN - floor(sides) * step_angle);
        scale = divided(cos(whole), cos(end));
    }
    Segment s = Segment(angle - id * step_angle - end, end, end);
    if (roundness > 0.0)
        s.bevel = atan((1.0 - roundness) * math_tangent(end));
    float d = bounded(scale * distance_of(s, l, roundness)), x = bounded(scale * parameter_of(s, l, roundness));
    float width = bounded(math_tangent(s.bevel) + spline_of(s, roundness) + roundness * (s.end - s.bevel));
    width = sides == 2.0 && roundness == 0.0 ? 0.0 : width;
    x = l == 0.0 ? 0.0 : x;
    if (normalized) {
        x = width == 0.0 ? x : divided(x, scale * largest_parameter(s, l, d / max(scale, 1e-6), roundness));
        return RadialTiling(vec3(0.5 * x + 0.5, d, 0.0), id, width, id * step_angle + end);
    }
    return RadialTiling(vec3(x, d - 1.0, 0.0), id, width, id * step_angle + end);
}
