// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    add what each triangle brings to each voxel that it touches, weighted by its area inside the voxel, so that
//             tessellation and overlap change nothing.
// Formula:    sum_i A_i x_i
// In:         triangles, materials, Occupancy, VoxelFirst (number of a word's first voxel)
// Out:        Sums: per voxel area, albedo, normal, covered area, the voxel, emission: u_n_sums words
// Invocation: one strip of columns of one triangle

#include "bind/voxel_part.glsl"
#include "bind/voxel_sums.glsl"
#include "bind/voxels.glsl"

layout(std430) readonly buffer VoxelFirst { uint voxel_first[]; };

void visit(Strip strip, ivec3 cell)
{
    ivec3 voxel = turned_back(cell, strip.shape.axis);
    uvec2 address = occupancy_address(voxel);
    uint word = occupancy[address.x], bit = 1u << address.y;
    if ((word & bit) == 0u)  // a touch that voxelize/mark, compiled apart, rounded otherwise
        return;
    uint at = (voxel_first[address.x] + uint(bitCount(word & (bit - 1u)))) * uint(u_n_sums);
    Part part = part_of(strip, cell);
    Piece piece = part.piece;
    add(at, piece.weight);
    add(at + 1u, piece.weight * part.albedo);
    add(at + 4u, piece.weight * turned_back(piece.normal, strip.shape.axis));
    add(at + 7u, piece.area * abs(piece.normal.z) * part.alpha);
    sums[at + 8u] = uint(voxel.x | voxel.y << 10 | voxel.z << 20);  // the same from every writer
    if (u_emission_unit > 0.0)
        add(at + 9u, piece.weight * part.emission / u_emission_unit);
}
