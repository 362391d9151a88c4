// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: Radial Tiling: the plane in segments around a polygon whose corners are round, with coordinates in each.

struct RadialTiling {
    vec3 coordinates;
    float id;
    float width;
    float rotation;
};

const float TILING_TAU = 6.28318530718;

// Half a segment: its angle, the angle at which its corner's arc ends, how round that is, and how much larger than at the
// other sides a unit is along it.
struct HalfSegment {
    float angle;
    float bevel;
    float roundness;
    float unit;
};

HalfSegment half_segment(float angle, float roundness, float unit)
{
    return HalfSegment(angle, roundness == 0.0 ? 0.0 : angle - atan((1.0 - roundness) * tan(angle)), roundness, unit);
}

// How far along its side a segment reaches; height: where, 1 at the polygon.
float reach_of(HalfSegment s, float height)
{
    return height * tan(s.angle - s.bevel) + 0.5 * (1.0 - s.roundness) * s.bevel * (height + 1.0) + s.roundness * s.bevel;
}

// Along a straight side, at an angle to its middle; or, in units of the segment's reach.
float along_side(HalfSegment s, float height, float angle, bool normalizes)
{
    float p = height * tan(angle);
    return normalizes ? p / reach_of(s, height) : s.unit * p;
}

// Along a corner's arc, `by` past its end, at a distance from the centre: a parabola leads from the side's measure to the arc's.
float along_arc(HalfSegment s, float height, float distance, float by, bool normalizes)
{
    float e = s.angle - s.bevel, start = (1.0 - s.roundness) * s.bevel, x = distance * cos(e);
    float p = distance * sin(e) + (by < start ? x * by + 0.5 * (1.0 - x) * by * by / start : 0.5 * start * (x - 1.0) + by);
    float reach = distance * sin(e) + 0.5 * start * (x + 1.0) + s.roundness * s.bevel;
    return normalizes ? p / mix(reach_of(s, height), reach, by / s.bevel) : s.unit * p;
}

// Distance from the origin to the far side of a circle, in the direction of an angle.
float to_circle(float angle, vec2 center, float radius)
{
    float q = dot(vec2(cos(angle), sin(angle)), center);
    return q + sqrt(max(q * q + radius * radius - dot(center, center), 0.0));
}

RadialTiling radial_tiling(vec3 at, float sides, float roundness, bool normalizes)
{
    if (any(isnan(at.xy)))
        at.xy = vec2(0.0);
    float n = sides >= 2.0 ? min(sides, 1e6) : 2.0, r = roundness >= 0.0 ? min(roundness, 1.0) : 0.0, rho = length(at.xy);
    float turn = at.xy == vec2(0.0) ? 0.0 : atan(at.y, at.x), phi = turn + (at.y < 0.0 ? TILING_TAU : 0.0);
    HalfSegment s = half_segment(0.5 * TILING_TAU / n, r, 1.0), last = s, outer = s;
    float k = floor(phi / (2.0 * s.angle)), a = phi - k * 2.0 * s.angle, width = reach_of(s, 1.0);
    // Where the number of sides is not whole, the last one is smaller, and the arcs at its ends are others
    vec2 center = vec2(0.0);
    float radius = 0.0, end = TILING_TAU;
    bool is_irregular = fract(n) != 0.0;
    if (is_irregular) {
        float angle = 0.5 * TILING_TAU - floor(n) * s.angle;
        last = half_segment(angle, r, cos(s.angle) / cos(angle));
        end -= 2.0 * angle;
        radius = r * tan(angle) / tan(0.5 * (s.angle + angle));
        center = vec2(cos(last.bevel), -sin(last.bevel)) / cos(angle - last.bevel) + radius * vec2(-cos(angle), sin(angle));
        vec2 start = center + radius * vec2(cos(s.angle), sin(s.angle));
        outer.bevel = atan(start.y / start.x);
        outer.roundness = 1.0 - tan(s.angle - outer.bevel) / tan(s.angle);
    }
    float height, p;
    if (!is_irregular || (phi >= outer.bevel && phi < end - outer.bevel)) {
        bool is_next = is_irregular && (phi < s.angle || phi >= end - s.angle);
        float away = a > s.angle ? 2.0 * s.angle - a : a;  // from the nearer end
        if (away >= s.bevel || (is_irregular && (phi < s.bevel || phi >= end - s.bevel))) {
            height = rho * cos(s.angle - a);
            bool is_endless = n == 2.0 && r == 0.0;
            width = is_endless ? 0.0 : width;
            p = along_side(is_next ? outer : s, height, abs(s.angle - a), normalizes && !is_endless);
        } else {
            height = rho / to_circle(away, vec2((1.0 - r) / cos(s.angle), 0.0), r);
            p = along_arc(s, height, rho, s.bevel - away, normalizes);
        }
    } else {
        bool is_before = phi >= end - outer.bevel && phi < TILING_TAU - last.angle;
        float m = is_before ? end - phi : turn;  // from the nearer end of the last one, negative in it
        bool is_in = phi >= end + last.bevel && phi < TILING_TAU - last.bevel;
        height = is_in ? rho * cos(last.angle - a) : rho / to_circle(m, center, radius);
        if (is_in)
            p = along_side(last, height, abs(last.angle - a), normalizes);
        else if (m < 0.0)
            p = along_arc(last, height, rho, last.bevel + m, normalizes);
        else
            p = along_arc(outer, last.unit * height, rho, outer.bevel - m, normalizes);
        height *= last.unit;
        if (is_in || m < 0.0) {
            s.angle = last.angle;
            width = tan(last.angle - last.bevel) + 0.5 * (1.0 - r) * last.bevel * (1.0 + last.unit)
                  + last.unit * r * last.bevel;
        }
    }
    p = rho == 0.0 || isnan(p) || isinf(p) ? 0.0 : a < s.angle ? -p : p;
    float id = floor(n * (turn / TILING_TAU + (at.y < 0.0 ? 1.0 : 0.0)));
    return RadialTiling(vec3(normalizes ? 0.5 * p + 0.5 : p, normalizes ? height : height - 1.0, 0.0), id, width,
                        k * TILING_TAU / n + s.angle);
}
