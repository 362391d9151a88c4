// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what rays know of materials: which share of them each one stops. All else is for programs that trace nothing.

#include "bind/baked.glsl"
#include "bind/textures.glsl"

layout(std430) readonly buffer Opacities { Opacity opacities[]; };  // of each material
layout(std430) readonly buffer Cutouts { uint cutouts[]; };         // of each instance: 0 if it stops every ray

uniform bool u_sees_trees;  // whether what trees of nodes let through is decided when they are evaluated

float opacity_at(uint instance, uint triangle, vec2 bary)
{
    uint at = baked_at(instance, triangle, bary);
    if (at != NOT_BAKED)
        return u_sees_trees ? 1.0 : uintBitsToFloat(texelFetch(u_baked, int(at)).y);
    Opacity o = opacities[material_of(instance, triangle)];
    return o.alpha_texture >= 0 ? o.alpha * texture_value(o.alpha_texture, uv_at(triangle, bary)) : o.alpha;
}
