// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the lamps' light at a point, with traced shadows.

#include "bind/trace.glsl"
#include "lib/light_sampling.glsl"

const int N_LIGHTS = 0;
const float SHADOW_END = 0.9999;  // of the way: the lamp may touch a surface

layout(std430) readonly buffer Lights { Light lights[]; };

// One point of lamp i as seen from p: what it brings to a surface with normal n_geometric there, shadows included.
LightSample visible_light(int i, vec3 p, vec3 n_geometric, vec2 u, uint seed)
{
    LightSample s = sample_light(lights[i], p, u);
    bool is_dark = s.E_perp == vec3(0.0) || dot(n_geometric, s.wi) <= 0.0;
    if (is_dark || (lights[i].casts_shadow != 0u
                    && trace_any(offset_origin(p, n_geometric, s.wi), s.wi, s.distance * SHADOW_END, seed)))
        s.E_perp = vec3(0.0);
    return s;
}

// Irradiance [W m^-2] from all lamps on a surface with shading normal n.
vec3 lamps_irradiance(vec3 p, vec3 n, vec3 n_geometric, uint sample_index, uint seed)
{
    vec3 E = vec3(0.0);
    for (int i = 0; i < N_LIGHTS; i++) {
        LightSample s = visible_light(i, p, n_geometric, r2_point(sample_index, seed + uint(i)), seed);
        E += max(dot(n, s.wi), 0.0) * s.E_perp;
    }
    return E;
}
