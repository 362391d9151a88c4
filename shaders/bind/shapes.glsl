// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: grounds that are none of Lambert's: a plane of their own, read where a point says so.

#include "bind/wave.glsl"
#include "lib/shapes.glsl"

uint at_shape(uint set)
{
    return set + HIT_PLANES + POINT_PLANES - 1u;
}

void put_shape(uint set, uint slot, Shape s)
{
    uint kind_and_red = s.kind << 16u | packHalf2x16(vec2(min(s.color.r, 6e4), 0.0));
    wave[at_plane(at_shape(set), slot)] = uvec4(kind_and_red, packHalf2x16(min(s.color.gb, vec2(6e4))), floatBitsToUint(s.at));
}

Shape get_shape(uint set, uint slot)
{
    uvec4 words = wave[at_plane(at_shape(set), slot)];
    return Shape(words.x >> 16u, uintBitsToFloat(words.zw), vec3(unpackHalf2x16(words.x).x, unpackHalf2x16(words.y)));
}

// How much more light along wi counts at the ground of point p than Lambert's would have it. A loop instead of a branch: a
// processor that renders computes untaken branches, but leaves out loops that nobody enters.
vec3 ground_factor(Point p, uint slot, vec3 wi)
{
    vec3 factor = vec3(1.0);
    int n = is_kind(p, POINT_SHAPED) ? 1 : 0;
    for (int i = 0; i < n; i++)
        factor = shape_factor(get_shape(u_set, slot), p.normal, -get(u_set + 1u, slot).xyz, wi);
    return factor;
}
