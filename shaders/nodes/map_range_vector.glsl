// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Map Range node for vectors.

#include "nodes/bounded.glsl"

vec3 mapped3(vec3 factor, vec3 to_first, vec3 to_last)
{
    return bounded3(to_first + factor * (to_last - to_first));
}

vec3 map_vector_linear(vec3 v, vec3 first, vec3 last, vec3 to_first, vec3 to_last)
{
    return mapped3(divided3(v - first, last - first), to_first, to_last);
}

vec3 map_vector_stepped(vec3 v, vec3 first, vec3 last, vec3 to_first, vec3 to_last, vec3 steps)
{
    vec3 stepped = divided3(floor(bounded3(divided3(v - first, last - first) * (steps + 1.0))), steps);
    return mapped3(mix(vec3(0.0), stepped, greaterThan(steps, vec3(0.0))), to_first, to_last);
}

vec3 map_vector_smooth(vec3 v, vec3 first, vec3 last, vec3 to_first, vec3 to_last)
{
    vec3 t = clamp(divided3(v - first, last - first), 0.0, 1.0);
    return mapped3((3.0 - 2.0 * t) * t * t, to_first, to_last);
}

vec3 map_vector_smoother(vec3 v, vec3 first, vec3 last, vec3 to_first, vec3 to_last)
{
    vec3 t = clamp(divided3(v - first, last - first), 0.0, 1.0);
    return mapped3(t * t * t * (t * (t * 6.0 - 15.0) + 10.0), to_first, to_last);
}

vec3 clamp_vector_in_range(vec3 v, vec3 a, vec3 b)
{
    return min(max(v, min(a, b)), max(a, b));
}
