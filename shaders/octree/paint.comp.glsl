// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    add what each triangle looks like to each surfel, weighted as in octree/accumulate.
// Formula:    sum_i A_i x_i
// In:         triangles, materials, octree
// Out:        Sums: per surfel albedo, share of it that goes through, emission: u_n_sums words
// Invocation: one strip of columns of one triangle

#include "bind/voxel_part.glsl"
#include "bind/voxel_sums.glsl"
#include "bind/octree.glsl"

void visit(Strip strip, ivec3 cell)
{
    uint surfel = find_surfel(turned_back(cell, strip.shape.axis), strip.shape.axis), at = surfel * uint(u_n_sums);
    if (surfel == NOTHING)  // see octree/accumulate
        return;
    Part part = part_of(strip, cell);
    add(at, part.piece.weight * part.albedo);
    add(at + 3u, part.piece.weight * part.through);
    if (u_emission_unit > 0.0)
        add(at + 4u, part.piece.weight * part.emission / u_emission_unit);
}
