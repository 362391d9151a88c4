// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    light that is drawn on each side of each surfel. It knows nothing of what the surfel looks like, so it stays
//             while colours are edited.
// Formula:    E from u_n_points times all draws with traced shadows
// In:         Surfels, lights, world; Draws of emitters
// Out:        Drawn: E of lamps, and after those of all sides E of what shines besides
// Invocation: one side of one surfel

#include "bind/lights.glsl"
#include "cache/side.glsl"

layout(std430) writeonly buffer Drawn { vec4 drawn[]; };
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
    drawn[side] = vec4(E / float(u_n_points), 0.0);
    drawn[u_n_sides + side] = vec4(E_still / float(u_n_points), 0.0);
}
