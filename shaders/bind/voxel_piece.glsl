// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the piece of one triangle that lies in one voxel.

#include "bind/visit_voxels.glsl"

const float LEAST = 1.0 / 8192.0;  // voxel faces that a mere touch weighs: where there is nothing else, means within 1 / 64

struct Piece {
    float area;    // inside the voxel; its voxel's face is 1
    float weight;  // that area, or LEAST
    vec3 middle;   // centroid, voxel units, axes turned as in lib/triangle_box.glsl
    vec3 normal;   // unit, axes turned
};

Piece piece_of(Strip strip, ivec3 cell)
{
    vec4 clipped = clipped_part(strip.shape, cell);
    return Piece(clipped.w, max(clipped.w, LEAST), clipped.xyz, unit_normal(strip.shape));
}
