// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light cache as rays see it: at each pixel the side of the surfel from which a ray that ends there takes
//             its light.
// Formula:    L = Le + rho / pi (E_lamps + E_indirect)
// In:         G-buffer, scene, light cache
// Out:        u_film: sums of RGBA
// Invocation: one pixel

#include "bind/cache.glsl"
#include "bind/film.glsl"
#include "bind/gbuffer.glsl"

const bool SHOW_ALBEDO = false;   // rho instead of L, each side in a shade of it, so that surfels can be told apart
const float DARKEST_SHADE = 0.7;

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2DArray u_film;

uniform uint u_first;
uniform uint u_end;

vec3 shown(uint side)
{
    Surfel s = surfels[side / 2u];
    if (SHOW_ALBEDO)
        return s.albedo * mix(DARKEST_SHADE, 1.0, float(hash(side) >> 8u) / 16777216.0);
    vec3 E = cache[cache_entry(LAMPS, side)].rgb + cache[cache_entry(INDIRECT, side)].rgb;
    return s.emission + s.albedo / PI * E;
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    Seen seen = seen_at(pixel, false);
    if (!seen.hit)
        return;
    uint side = cache_side(seen.surface.position, seen.surface.normal_geometric, -seen.wo);
    ivec3 at = ivec3(pixel, PLANE_COMBINED);
    imageStore(u_film, at, imageLoad(u_film, at) + vec4(side == NOTHING ? vec3(0.0) : shown(side), 1.0));
}
