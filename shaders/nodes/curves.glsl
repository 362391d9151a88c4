// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the nodes of curves: each curve is a table of RAMP_SIZE values between its first and its last x.

#include "nodes/ramp.glsl"

// Along the straight line through the first or the last two entries outside, by `beyond` of them being 1, else level.
float curve_at(Geo g, uint table, float x, float beyond)
{
    uint i = min(ramp_entry(x), RAMP_SIZE - 2u);
    float a = value_at(g, table + i), b = value_at(g, table + i + 1u);
    float rest = clamp(x, 0.0, 1.0) * float(RAMP_SIZE - 1u) - float(i);
    float outside = (x - clamp(x, 0.0, 1.0)) * float(RAMP_SIZE - 1u);
    return bounded(a * (1.0 - rest) + b * rest + beyond * outside * (b - a));
}

// Before the tables lie: the first x, the span of x, and whether the curve goes on outside.
vec3 curves_of_parts(Geo g, uint table, float factor, vec3 v)
{
    float beyond = value_at(g, table + 2u);
    vec3 x = divided3(bounded3(v - value_at(g, table)), vec3(value_at(g, table + 1u)));
    vec3 bent = vec3(curve_at(g, table + 3u, x.x, beyond), curve_at(g, table + 3u + RAMP_SIZE, x.y, beyond),
                     curve_at(g, table + 3u + 2u * RAMP_SIZE, x.z, beyond));
    return bounded3((1.0 - factor) * v + factor * bent);
}

float curve_of_number(Geo g, uint table, float factor, float a)
{
    float x = divided(bounded(a - value_at(g, table)), value_at(g, table + 1u));
    return bounded((1.0 - factor) * a + factor * curve_at(g, table + 3u, x, value_at(g, table + 2u)));
}
