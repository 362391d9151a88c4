// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    add what each triangle brings to each surfel, weighted by its area inside the voxel.
// Formula:    sum_i A_i x_i
// In:         triangles, materials, octree
// Out:        Sums: per surfel area, albedo, normal, centroid in the voxel, voxel and axis, how far out the outermost planes
//             lie that face front and back, emission: u_n_sums words
// Invocation: one strip of columns of one triangle

#include "bind/voxel_part.glsl"
#include "bind/voxel_sums.glsl"
#include "bind/octree.glsl"

void visit(Strip strip, ivec3 cell)
{
    int axis = strip.shape.axis;
    ivec3 voxel = turned_back(cell, axis);
    uint surfel = find_surfel(voxel, axis), at = surfel * uint(u_n_sums);
    if (surfel == NOTHING)  // a touch that octree/mark, compiled apart, rounded otherwise
        return;
    Part part = part_of(strip, cell);
    vec3 inside = turned_back(part.middle - vec3(cell), axis);
    bool is_front = part.normal.z * handedness(instances[strip.instance]) > 0.0;
    vec3 n = turned_back(part.normal.z < 0.0 ? -part.normal : part.normal, axis);
    add(at, part.weight);
    add(at + 1u, part.weight * part.albedo);
    add(at + 4u, part.weight * n);
    add(at + 7u, part.weight * inside);
    sums[at + 10u] = uint(voxel.x | voxel.y << 10 | voxel.z << 20) | uint(axis) << 30u;  // the same from every writer
    float height = dot(inside - 0.5, n);
    atomicMax(sums[at + (is_front ? 11u : 12u)], uint(round((1.0 + (is_front ? height : -height)) * ONE)));
    if (u_emission_unit > 0.0)
        add(at + 13u, part.weight * part.emission / u_emission_unit);
}
