// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the light cache: what each side of each surfel reflects. Side 0 is the one that the surfel's normal points from.

#include "bind/octree.glsl"
#include "lib/layouts.glsl"
#include "lib/math.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) buffer Cache { vec4 cache[]; };  // six parts, each with an entry for both sides of every surfel

const uint LAMPS = 0u;     // irradiance E from the lamps [W m^-2]
const uint STILL = 1u;     // irradiance E from what no bounce changes: the world and emissive surfaces
const uint INDIRECT = 2u;  // irradiance E from all but the lamps: STILL and what other surfels send
const uint RADIANCE = 3u;  // reflected radiance L [W m^-2 sr^-1], twice: read from one, written to the other
const uint SENT = 5u;      // radiance of all but what lamps send back from the same side, once no bounce is left

const uint MISSED = 0xfffffffeu;  // the link of a ray that meets nothing at all; of one that meets no surfel it is NOTHING

uniform uint u_n_sides;

// Index of a side's entry in a part.
uint cache_entry(uint part, uint side)
{
    return part * u_n_sides + side;
}

// The share of lamps' light that a side reflects, 16 bits a channel, in whole numbers that floats hold: they lie in the fourth
// numbers of SENT and LAMPS, which rays read anyway. To look elsewhere took a graphics card a third more time.
vec2 albedo_words(vec3 albedo)
{
    uvec3 c = uvec3(round(clamp(albedo, 0.0, 1.0) * 65535.0));
    return vec2(c.r | (c.b >> 8u) << 16u, c.g | (c.b & 255u) << 16u);
}

vec3 albedo_from(vec2 words)
{
    uvec2 w = uvec2(words);
    return vec3(w & 65535u, (w.x >> 16u) << 8u | w.y >> 16u) / 65535.0;
}

const float START = 0.05;  // voxels between a side and its rays: its mean position may lie below a curved surface

// Where the rays of a side start, n the surfel's normal turned to that side: over the outermost surface that faces this
// way, so that a board thinner than a voxel is not looked at from inside.
vec3 side_position(Surfel s, uint side, vec3 n)
{
    vec2 outer = unpackHalf2x16(s.outer);
    return s.position + n * ((START + (side % 2u == 0u ? outer.x : outer.y)) / u_voxels_per_metre);
}

// The surfel whose light is that of point p of surfel s: where another surface cuts the voxel and the mean position of s
// lies behind it, the one in the voxel beside, so that light of one room stays out of the other.
uint on_this_side(uint s, vec3 p_ws)
{
    ivec3 voxel = ivec3(floor(to_voxels(p_ws)));
    int axis = int(surfels[s].voxel >> 30u);
    int n_axes = u_n_node_words > 0u ? 3 : 0;  // see surfel_at
    for (int i = 1; i < n_axes; i++) {
        int other = (axis + i) % 3;
        uint wall = find_surfel(voxel, other);
        if (wall == NOTHING)
            continue;
        vec3 n = unpack_unit(surfels[wall].normal), at = surfels[wall].position;
        float height = dot(p_ws - at, n);
        if (height * dot(surfels[s].position - at, n) >= 0.0)
            continue;
        ivec3 beside = voxel;
        beside[other] += height > 0.0 ? 1 : -1;
        uint found = find_surfel(beside, axis);
        if (found != NOTHING)
            return found;
    }
    return s;
}

// Side of the cache at a surface point seen from the direction d of a ray, n any normal of the surface; or NOTHING.
uint cache_side(vec3 p_ws, vec3 n, vec3 d)
{
    uint surfel = surfel_at(to_voxels(p_ws), n);
    if (surfel == NOTHING)
        return NOTHING;
    surfel = on_this_side(surfel, p_ws);
    return 2u * surfel + (dot(unpack_unit(surfels[surfel].normal), d) < 0.0 ? 0u : 1u);
}
