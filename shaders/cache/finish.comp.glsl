// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what rays that end at a side find there, once no bounce is left: they read this and nothing else of surfels.
// Formula:    L = rho / pi ((1 - a) E + a (E' + E'_lamps)), a the share that goes through, from the other side
// In:         colours of surfels; Cache: INDIRECT, LAMPS
// Out:        Cache: SENT, and what of lamps' light the side reflects
// Invocation: one side of one surfel

#include "bind/cache.glsl"
#include "bind/surfel_colors.glsl"

layout(local_size_x = 64) in;

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint side = u_first + gl_GlobalInvocationID.x;
    if (side >= u_end)
        return;
    vec4 look = look_of_surfel(side / 2u);
    vec3 behind = cache[cache_entry(INDIRECT, side ^ 1u)].rgb + cache[cache_entry(LAMPS, side ^ 1u)].rgb;
    vec3 L = look.rgb / PI * mix(cache[cache_entry(INDIRECT, side)].rgb, behind, look.a);
    vec2 words = albedo_words(look.rgb * (1.0 - look.a));
    cache[cache_entry(SENT, side)] = vec4(L, words.x);
    cache[cache_entry(LAMPS, side)].w = words.y;
}
