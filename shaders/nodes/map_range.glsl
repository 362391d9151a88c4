// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Map Range node for numbers, and the Clamp node.

#include "nodes/bounded.glsl"

// 0 where there is no range, whatever the target is.
float mapped(float factor, float first, float last, float to_first, float to_last)
{
    return first != last ? bounded(to_first + factor * (to_last - to_first)) : 0.0;
}

float map_linear(float x, float first, float last, float to_first, float to_last)
{
    return mapped(divided(x - first, last - first), first, last, to_first, to_last);
}

float map_stepped(float x, float first, float last, float to_first, float to_last, float steps)
{
    float stepped = divided(floor(bounded(divided(x - first, last - first) * (steps + 1.0))), steps);
    return mapped(steps > 0.0 ? stepped : 0.0, first, last, to_first, to_last);
}

float map_smooth(float x, float first, float last, float to_first, float to_last)
{
    float t = clamp(divided(x - first, last - first), 0.0, 1.0);
    return mapped((3.0 - 2.0 * t) * t * t, first, last, to_first, to_last);
}

float map_smoother(float x, float first, float last, float to_first, float to_last)
{
    float t = clamp(divided(x - first, last - first), 0.0, 1.0);
    return mapped(t * t * t * (t * (t * 6.0 - 15.0) + 10.0), first, last, to_first, to_last);
}

float clamp_between(float x, float low, float high)
{
    return min(max(x, low), high);
}

// Whichever of the bounds is the lower.
float clamp_in_range(float x, float a, float b)
{
    return min(max(x, min(a, b)), max(a, b));
}
