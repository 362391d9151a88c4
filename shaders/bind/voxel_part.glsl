// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what one triangle brings to one voxel: the piece of it, and what that looks like.

#include "bind/voxel_piece.glsl"
#include "bind/baked.glsl"
#include "bind/principled.glsl"

struct Part {
    Piece piece;
    vec3 albedo;
    vec3 emission;  // radiance
    float alpha;
    float through;  // share of the albedo that sends light on to the other side
};

Part part_of(Strip strip, ivec3 cell)
{
    Piece piece = piece_of(strip, cell);
    Material m = materials[strip.material];
    vec2 bary = barycentrics(strip.shape, piece.middle);
    uint at = baked_at(strip.instance, strip.triangle, bary);
    if (at != NOT_BAKED) {
        Cell c = unpacked_cell(texelFetch(u_baked, int(at)));
        return Part(piece, c.albedo, c.emission, c.opacity, c.through);
    }
    Shading s = shading_at(m, uv_at(strip.triangle, bary));
    vec3 albedo = m.program == PROGRAM_MATTE ? clamp(s.base_color, 0.0, 1.0) : mean_albedo(m, s);
    return Part(piece, albedo, max(s.emission, 0.0), clamp(s.alpha, 0.0, 1.0), 0.0);
}
