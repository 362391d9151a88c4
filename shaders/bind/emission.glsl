// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what surfaces send out, to who does not evaluate trees of nodes.

#include "bind/baked.glsl"
#include "bind/textures.glsl"

layout(std430) readonly buffer Emissions { Emission emissions[]; };  // of each material

// Radiance that a surface sends out.
vec3 emission_of(uint instance, uint triangle, vec2 bary)
{
    uint at = baked_at(instance, triangle, bary);
    if (at != NOT_BAKED)
        return unpacked_cell(texelFetch(u_baked, int(at))).emission;
    Emission e = emissions[material_of(instance, triangle)];
    return e.color_texture >= 0 ? e.color * texture_color(e.color_texture, uv_at(triangle, bary)) : e.color;
}

// Which share of it is there.
float cover_of(uint instance, uint triangle, vec2 bary)
{
    uint at = baked_at(instance, triangle, bary);
    if (at != NOT_BAKED)
        return unpacked_cell(texelFetch(u_baked, int(at))).opacity;
    Emission e = emissions[material_of(instance, triangle)];
    return clamp(e.alpha_texture >= 0 ? e.alpha * texture_value(e.alpha_texture, uv_at(triangle, bary)) : e.alpha, 0.0, 1.0);
}
