// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light cache as rays see it: at each pixel the side of the surfel from which a ray that ends there takes
//             its light.
// Formula:    L = Le + rho / pi (E_lamps + E_indirect)
// In:         Wave: points, hits; light cache
// Out:        u_film: sums of RGBA
// Invocation: one pixel

#include "bind/cache.glsl"
#include "bind/film.glsl"
#include "bind/pixels.glsl"
#include "bind/surfel_colors.glsl"
#include "bind/wave.glsl"

uniform bool u_show_albedo;       // rho instead of L, each side in a shade of it, so that surfels can be told apart
const float DARKEST_SHADE = 0.7;

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2DArray u_film;

vec3 shown(uint side)
{
    vec3 albedo = albedo_of_surfel(side / 2u);
    if (u_show_albedo)
        return albedo * mix(DARKEST_SHADE, 1.0, float(hash(side) >> 8u) / 16777216.0);
    vec3 E = cache[cache_entry(LAMPS, side)].rgb + cache[cache_entry(INDIRECT, side)].rgb;
    return emission_of_surfel(side / 2u) + albedo / PI * E;
}

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x;
    if (slot >= u_end)
        return;
    Point p = get_point(u_set, slot);
    if (!is_kind(p, POINT_SURFACE))
        return;
    uint side = cache_side(p.position, p.normal_geometric, get_hit(u_set, slot).direction);
    ivec3 at = ivec3(pixel_of(slot), u_planes[COMBINED]);
    imageStore(u_film, at, imageLoad(u_film, at) + vec4(side == NOTHING ? vec3(0.0) : shown(side), 1.0));
}
