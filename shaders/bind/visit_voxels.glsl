// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the entry point of passes over all voxels that the triangles touch. One invocation a tile; whoever includes
// this says in `visit` what to do with a voxel.

#include "bind/voxel_work.glsl"

layout(local_size_x = 64) in;

uniform uint u_first;
uniform uint u_end;

// The tile's triangle touches `cell`, axes turned as in lib/triangle_box.glsl.
void visit(Tile tile, ivec3 cell);

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
                if (touches_cell(tile.shape, ivec3(x, y, z)))
                    visit(tile, ivec3(x, y, z));
        }
}
