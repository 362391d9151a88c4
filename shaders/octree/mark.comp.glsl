// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    set the bit of every surfel: each voxel that a triangle touches, in the mask of the triangle's widest axis.
// In:         triangles, TileFirst, the top half of Octree
// Out:        node masks of Octree
// Invocation: one tile of 8x8 columns of one triangle

#include "bind/visit_voxels.glsl"
#include "bind/octree.glsl"

void visit(Tile tile, ivec3 cell)
{
    ivec3 voxel = turned_back(cell, tile.shape.axis);
    uvec2 bit = surfel_bit(find_node(voxel), voxel, tile.shape.axis);
    atomicOr(octree[bit.x], 1u << bit.y);
}
