// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: ramps and curves as tables that the host has sampled.

#include "bind/geo.glsl"
#include "nodes/bounded.glsl"

const uint RAMP_SIZE = 257u;  // entries, as in Cycles

// Where x in [0, 1] lies in a table, from below.
uint ramp_entry(float x)
{
    return min(uint(clamp(x, 0.0, 1.0) * float(RAMP_SIZE - 1u)), RAMP_SIZE - 1u);
}

float ramp_rest(float x)
{
    return clamp(x, 0.0, 1.0) * float(RAMP_SIZE - 1u) - float(ramp_entry(x));
}

// A table of colours, alpha after all of them.
vec3 ramp_color_stepped(Geo g, uint table, float x)
{
    return value3_at(g, table + 3u * ramp_entry(x));
}

vec3 ramp_color(Geo g, uint table, float x)
{
    uint i = ramp_entry(x), next = min(i + 1u, RAMP_SIZE - 1u);
    return mix(value3_at(g, table + 3u * i), value3_at(g, table + 3u * next), ramp_rest(x));
}

float ramp_alpha_stepped(Geo g, uint table, float x)
{
    return value_at(g, table + 3u * RAMP_SIZE + ramp_entry(x));
}

float ramp_alpha(Geo g, uint table, float x)
{
    uint i = ramp_entry(x), next = min(i + 1u, RAMP_SIZE - 1u);
    uint first = table + 3u * RAMP_SIZE;
    return mix(value_at(g, first + i), value_at(g, first + next), ramp_rest(x));
}
