// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    set the bit of every surfel: each voxel that a triangle touches, in the mask of the triangle's widest axis.
// In:         triangles, StripFirst, the top half of Octree
// Out:        node masks of Octree; OR knows no order, so the bits are the same in every run
// Invocation: one strip of columns of one triangle

#include "bind/visit_voxels.glsl"
#include "bind/octree.glsl"

void visit(Strip strip, ivec3 cell)
{
    ivec3 voxel = turned_back(cell, strip.shape.axis);
    uint node = find_node(voxel);
    if (node == NOTHING)  // a touch that octree/mark_nodes, compiled apart, rounded otherwise
        return;
    uvec2 bit = surfel_bit(node, voxel, strip.shape.axis);
    atomicOr(octree[bit.x], 1u << bit.y);
}
