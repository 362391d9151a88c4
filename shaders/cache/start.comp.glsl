// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light cache before its first bounce: what was drawn and found, and the first radiance that it makes.
// Formula:    L = rho / pi E_lamps, of light from the own side: what goes through, is taken from the other one by who reads
// In:         Drawn, Found, colours of surfels
// Out:        Cache: LAMPS, STILL, RADIANCE, zeros into INDIRECT
// Invocation: one side of one surfel

#include "bind/cache.glsl"
#include "bind/surfel_colors.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer Drawn { vec4 drawn[]; };
layout(std430) readonly buffer Found { vec4 found_light[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint side = u_first + gl_GlobalInvocationID.x;
    if (side >= u_end)
        return;
    vec3 E = drawn[side].rgb;
    vec4 look = look_of_surfel(side / 2u);
    cache[cache_entry(LAMPS, side)] = vec4(E, 0.0);
    cache[cache_entry(STILL, side)] = vec4(drawn[u_n_sides + side].rgb + found_light[side].rgb, 0.0);
    cache[cache_entry(INDIRECT, side)] = vec4(0.0);
    cache[cache_entry(RADIANCE, side)] = vec4(look.rgb / PI * E, look.a);
}
