// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the lamps' light on each side of each surfel, and the first outgoing radiance.
// Formula:    L = Le + rho / pi E, E from N_POINTS points of each lamp with traced shadows
// In:         Surfels, lamps, triangles
// Out:        Cache: LAMPS, RADIANCE, and zeros into INDIRECT
// Invocation: one side of one surfel

#include "bind/cache.glsl"
#include "bind/lights.glsl"

const int N_POINTS = 4;

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint side = u_first + gl_GlobalInvocationID.x;
    if (side >= u_end)
        return;
    Surfel surfel = surfels[side / 2u];
    Surface s;
    s.normal = s.normal_geometric = unpack_unit(surfel.normal) * (side % 2u == 0u ? 1.0 : -1.0);
    s.position = side_position(surfel, side, s.normal);
    s.lift = vec3(0.0);
    vec3 E = vec3(0.0);
    for (int k = 0; k < N_POINTS; k++)
        E += lamps_irradiance(s, uint(k), hash(side)) / float(N_POINTS);
    cache[cache_entry(LAMPS, side)] = vec4(E, 0.0);
    cache[cache_entry(INDIRECT, side)] = vec4(0.0);
    cache[cache_entry(RADIANCE, side)] = vec4(surfel.emission + surfel.albedo / PI * E, 0.0);
}
