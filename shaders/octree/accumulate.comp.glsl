// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    add where each triangle lies in each surfel, weighted by its area inside the voxel. What it looks like is
//             octree/paint's.
// Formula:    sum_i A_i x_i
// In:         triangles, octree
// Out:        Sums: per surfel area, normal, centroid in the voxel, voxel and axis, how far out the outermost planes lie that
//             face front and back: u_n_sums words
// Invocation: one strip of columns of one triangle

#include "bind/voxel_piece.glsl"
#include "bind/voxel_sums.glsl"
#include "bind/octree.glsl"

void visit(Strip strip, ivec3 cell)
{
    int axis = strip.shape.axis;
    ivec3 voxel = turned_back(cell, axis);
    uint surfel = find_surfel(voxel, axis), at = surfel * uint(u_n_sums);
    if (surfel == NOTHING)  // a touch that octree/mark, compiled apart, rounded otherwise
        return;
    Piece piece = piece_of(strip, cell);
    vec3 inside = turned_back(piece.middle - vec3(cell), axis);
    bool is_front = piece.normal.z * handedness(instances[strip.instance]) > 0.0;
    vec3 n = turned_back(piece.normal.z < 0.0 ? -piece.normal : piece.normal, axis);
    add(at, piece.weight);
    add(at + 1u, piece.weight * n);
    add(at + 4u, piece.weight * inside);
    sums[at + 7u] = uint(voxel.x | voxel.y << 10 | voxel.z << 20) | uint(axis) << 30u;  // the same from every writer
    float height = dot(inside - 0.5, n);
    atomicMax(sums[at + (is_front ? 8u : 9u)], uint(round((1.0 + (is_front ? height : -height)) * ONE)));
}
