// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    light that is drawn on each side of each surfel, and the first radiance that it reflects.
// Formula:    L = rho / pi E_lamps, E from N_POINTS times all draws with traced shadows
// In:         Surfels, lights, triangles, world; Found: what N_RAYS rays found
// Out:        Cache: LAMPS, STILL, RADIANCE, zeros into INDIRECT
// Invocation: one side of one surfel

#include "bind/lights.glsl"
#include "cache/side.glsl"

const int N_POINTS = 4;
const int N_RAYS = 16;  // of cache/link, which find emitters and the world too

layout(std430) readonly buffer Found { vec4 found_light[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint side = u_first + gl_GlobalInvocationID.x;
    if (side >= u_end)
        return;
    Surface s = surface_of_side(side), mean = s;  // how near a lamp is, is told from the mean position
    mean.position = surfels[side / 2u].position;
    mean.lift = s.position - mean.position;
    vec3 E = vec3(0.0), E_still = vec3(0.0);
    for (int i = 0; i < N_POINTS * n_draws(); i++) {
        int k = i % n_draws();
        bool is_lamp = k < n_lamp_draws(N_TREE_DRAWS);
        LightDraw draw = draw_light(k, is_lamp ? mean : s, uint(i / n_draws()), hash(side));
        float NoL = max(dot(s.normal, draw.wi), 0.0);
        if (is_lamp)
            E += NoL * draw.E_perp;
        else
            E_still += NoL * draw.E_perp * balance(float(N_POINTS) * draw.pdf, float(N_RAYS) * NoL / PI);
    }
    E /= float(N_POINTS);
    cache[cache_entry(LAMPS, side)] = vec4(E, 0.0);
    cache[cache_entry(STILL, side)] = vec4(found_light[side].rgb + E_still / float(N_POINTS), 0.0);
    cache[cache_entry(INDIRECT, side)] = vec4(0.0);
    cache[cache_entry(RADIANCE, side)] = vec4(surfels[side / 2u].albedo / PI * E, 0.0);
}
