// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the lamps' light at a point, with traced shadows.

#include "bind/trace.glsl"
#include "lib/light_sampling.glsl"

const int N_LIGHTS = 0;
const float SHADOW_END = 0.9999;  // of the way: the lamp may touch a surface

layout(std430) readonly buffer Lights { Light lights[]; };

// One point of lamp i as seen from a surface that faces the eye or ray which sees it, shadows included. The ray starts on
// the curved surface that the triangle stands for, so that smooth shading ends smoothly [Hanika21].
LightSample visible_light(int i, Surface s, vec2 u, uint seed)
{
    LightSample light = sample_light(lights[i], s.position, u);
    vec3 o = offset_origin(s.position + s.lift, s.normal_geometric, s.normal_geometric);
    if (light.E_perp == vec3(0.0) || dot(s.normal, light.wi) <= 0.0
        || (lights[i].casts_shadow != 0u && trace_any(o, light.wi, light.distance * SHADOW_END, seed)))
        light.E_perp = vec3(0.0);
    return light;
}

// Irradiance [W m^-2] from all lamps.
vec3 lamps_irradiance(Surface s, uint sample_index, uint seed)
{
    vec3 E = vec3(0.0);
    for (int i = 0; i < N_LIGHTS; i++) {
        LightSample light = visible_light(i, s, r2_point(sample_index, seed + uint(i)), hash(seed + sample_index));
        E += max(dot(s.normal, light.wi), 0.0) * light.E_perp;
    }
    return E;
}
