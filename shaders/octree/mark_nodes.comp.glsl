// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    set the bit of every node: each 4x4x4 voxels of which a triangle touches one.
// In:         triangles, StripFirst
// Out:        Octree: the top masks alone; OR knows no order, so the bits are the same in every run
// Invocation: one strip of columns of one triangle

#include "bind/visit_voxels.glsl"
#include "bind/octree.glsl"

void visit(Strip strip, ivec3 cell)
{
    uvec2 bit = node_bit(turned_back(cell, strip.shape.axis));
    if ((octree[bit.x] >> bit.y & 1u) == 0u)  // most are set already
        atomicOr(octree[bit.x], 1u << bit.y);
}
