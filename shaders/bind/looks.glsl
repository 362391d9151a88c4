// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what surfaces look like to who does not evaluate trees of nodes: by the table of materials, or as baked.

#include "bind/baked.glsl"
#include "bind/materials.glsl"

// Radiance that a surface sends out.
vec3 emission_of(uint instance, uint triangle, vec2 bary)
{
    uint at = baked_at(instance, triangle, bary);
    if (at != NOT_BAKED)
        return unpacked_cell(texelFetch(u_baked, int(at))).emission;
    return emission_at(materials[material_of(instance, triangle)], uv_at(triangle, bary));
}

// Which share of rays it stops.
float cover_of(uint instance, uint triangle, vec2 bary)
{
    uint at = baked_at(instance, triangle, bary);
    if (at != NOT_BAKED)
        return unpacked_cell(texelFetch(u_baked, int(at))).opacity;
    return clamp(alpha_at(materials[material_of(instance, triangle)], uv_at(triangle, bary)), 0.0, 1.0);
}
