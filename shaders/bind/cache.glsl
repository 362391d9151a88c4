// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the light cache: what each side of each surfel sends out. Side 0 is the one that the surfel's normal points from.

#include "bind/octree.glsl"
#include "lib/layouts.glsl"
#include "lib/math.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) buffer Cache { vec4 cache[]; };  // four parts, each with an entry for both sides of every surfel

const uint LAMPS = 0u;     // irradiance E from the lamps [W m^-2]
const uint INDIRECT = 1u;  // irradiance E from all else
const uint RADIANCE = 2u;  // outgoing radiance L [W m^-2 sr^-1], twice: read from one, written to the other

uniform uint u_n_sides;

// Index of a side's entry in a part.
uint cache_entry(uint part, uint side)
{
    return part * u_n_sides + side;
}

const float START = 0.05;  // voxels between a side and its rays: its mean position may lie below a curved surface

// Where the rays of a side start, n the surfel's normal turned to that side: over the outermost surface that faces this
// way, so that a board thinner than a voxel is not looked at from inside.
vec3 side_position(Surfel s, uint side, vec3 n)
{
    vec2 outer = unpackHalf2x16(s.outer);
    return s.position + n * ((START + (side % 2u == 0u ? outer.x : outer.y)) / u_voxels_per_metre);
}

// Side of the cache at a surface point seen from the direction d of a ray, n any normal of the surface; or NOTHING.
uint cache_side(vec3 p_ws, vec3 n, vec3 d)
{
    uint surfel = surfel_at(to_voxels(p_ws), n);
    if (surfel == NOTHING)
        return NOTHING;
    return 2u * surfel + (dot(unpack_unit(surfels[surfel].normal), d) < 0.0 ? 0u : 1u);
}
