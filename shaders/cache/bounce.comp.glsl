// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one more bounce: each side of each surfel gathers what the others sent out before. Double-buffered, so that
//             the order of invocations does not matter. Once a sweep has changed nothing, those after it end at once.
// Formula:    E = E_still + pi / N sum L(w_i), w_i distributed as cos; L' = rho / pi (E_lamps + E)
// In:         colours of surfels, Links, Cache: RADIANCE of the sweep before, LAMPS and STILL; Changes of the sweeps before
// Out:        Cache: the other RADIANCE, INDIRECT; Changes: largest change of any L (bits of a positive float)
// Invocation: one side of one surfel

#include "bind/cache.glsl"
#include "bind/surfel_colors.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer Links { uint links[]; };
layout(std430) buffer Changes { uint changes[]; };  // of each sweep

uniform uint u_first;
uniform uint u_end;
uniform uint u_n_rays;
uniform uint u_sweep;
uniform float u_tolerance;  // of the brightest change: a smaller one is none

bool has_settled()
{
    float brightest = 0.0;
    for (uint i = 0u; i < u_sweep; i++)
        brightest = max(brightest, uintBitsToFloat(changes[i]));
    return u_sweep > 0u && uintBitsToFloat(changes[u_sweep - 1u]) <= u_tolerance * brightest;
}

// Radiance of a side: of light that came to it, and of what goes through from the other one. A loop that few enter, not a branch
// that processors compute for all.
vec3 sent_from(uint part, uint side)
{
    vec4 own = cache[cache_entry(part, side)];
    int n = own.a > 0.0 ? 1 : 0;
    for (int i = 0; i < n; i++)
        own.rgb = mix(own.rgb, cache[cache_entry(part, side ^ 1u)].rgb, own.a);
    return own.rgb;
}

void main()
{
    uint side = u_first + gl_GlobalInvocationID.x, from = RADIANCE + u_sweep % 2u, to = RADIANCE + 1u - u_sweep % 2u;
    if (side >= u_end || has_settled())
        return;
    vec3 E = vec3(0.0);
    for (uint k = 0u; k < u_n_rays; k++) {
        uint link = links[k * u_n_sides + side];
        if (link < MISSED)
            E += PI / float(u_n_rays) * sent_from(from, link);
    }
    E += cache[cache_entry(STILL, side)].rgb;
    cache[cache_entry(INDIRECT, side)] = vec4(E, 0.0);
    vec4 look = look_of_surfel(side / 2u);
    vec3 L = look.rgb / PI * (cache[cache_entry(LAMPS, side)].rgb + E);
    vec3 change = abs(L - cache[cache_entry(from, side)].rgb);
    cache[cache_entry(to, side)] = vec4(L, look.a);
    atomicMax(changes[u_sweep], floatBitsToUint(max(change.r, max(change.g, change.b))));
}
