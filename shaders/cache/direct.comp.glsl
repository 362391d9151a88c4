// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    light that is drawn on each side of each surfel, and the first radiance that it reflects.
// Formula:    L = rho / pi E_lamps, E from u_n_points times all draws with traced shadows
// In:         Surfels, lights, world; Draws of emitters; Found: what u_n_rays rays found
// Out:        Cache: LAMPS, STILL, RADIANCE, zeros into INDIRECT
// Invocation: one side of one surfel

#include "bind/lights.glsl"
#include "cache/side.glsl"

layout(std430) readonly buffer Found { vec4 found_light[]; };
layout(std430) readonly buffer Draws { LightDraw draws[]; };  // u_n_points times u_n_emitter_draws a side

uniform uint u_first;
uniform uint u_end;
uniform uint u_start;   // sides of the parts before this one
uniform uint u_stride;  // sides of this part
uniform int u_n_points;
uniform int u_n_rays;   // of cache/link, which find emitters and the world too

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x, side = u_start + slot;
    if (slot >= u_end)
        return;
    Surface s = surface_of_side(side), mean = s;  // how near a lamp is, is told from the mean position
    mean.position = surfels[side / 2u].position;
    mean.lift = s.position - mean.position;
    vec3 E = vec3(0.0), E_still = vec3(0.0);
    int n = n_draws(), first = n_lamp_draws(u_n_tree_draws);
    for (int i = 0; i < u_n_points * n; i++) {
        int k = i % n, point = i / n;
        bool is_lamp = k < first;
        LightDraw emitter = NO_DRAW;
        if (!is_lamp && k < first + u_n_emitter_draws)
            emitter = draws[uint(point * u_n_emitter_draws + k - first) * u_stride + slot];
        Way way;
        Crossing c;
        LightDraw draw = draw_light(k, u_n_tree_draws, emitter, is_lamp ? mean : s, uint(point), hash(side), way);
        if (trace(way, c))
            continue;
        float NoL = max(dot(s.normal, draw.wi), 0.0);
        if (is_lamp)
            E += NoL * draw.E_perp;
        else
            E_still += NoL * draw.E_perp * balance(float(u_n_points) * draw.pdf, float(u_n_rays) * NoL / PI);
    }
    E /= float(u_n_points);
    cache[cache_entry(LAMPS, side)] = vec4(E, 0.0);
    cache[cache_entry(STILL, side)] = vec4(found_light[side].rgb + E_still / float(u_n_points), 0.0);
    cache[cache_entry(INDIRECT, side)] = vec4(0.0);
    cache[cache_entry(RADIANCE, side)] = vec4(surfels[side / 2u].albedo / PI * E, 0.0);
}
