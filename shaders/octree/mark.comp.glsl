// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    set the bit of every surfel: each voxel that a triangle touches, in the mask of the triangle's widest axis.
// In:         triangles, TileFirst, the top half of Octree
// Out:        node masks of Octree
// Invocation: one tile of 8x8 columns of one triangle

#include "bind/voxel_work.glsl"
#include "bind/octree.glsl"

layout(local_size_x = 64) in;

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    if (index >= u_end)
        return;
    Tile tile = tile_at(index);
    for (int y = tile.low.y; y <= tile.high.y; y++)
        for (int x = tile.low.x; x <= tile.high.x; x++) {
            if (!touches_column(tile.shape, ivec2(x, y)))
                continue;
            ivec2 range = column_range(tile.shape, ivec2(x, y));
            for (int z = range.x; z <= range.y; z++)
                if (touches_cell(tile.shape, ivec3(x, y, z))) {
                    ivec3 voxel = turned_back(ivec3(x, y, z), tile.shape.axis);
                    uvec2 bit = surfel_bit(find_node(voxel), voxel, tile.shape.axis);
                    atomicOr(octree[bit.x], 1u << bit.y);
                }
        }
}
