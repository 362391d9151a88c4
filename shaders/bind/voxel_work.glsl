// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: voxelization's work, cut evenly: one tile is 8x8 columns of one triangle's rectangle, so that a wall of the
// room keeps as many invocations busy as a thousand small triangles.

#include "bind/geometry.glsl"
#include "bind/grid.glsl"
#include "lib/triangle_box.glsl"

layout(std430) buffer TileFirst { uint tile_first[]; };  // tiles of all triangles before this one

uniform uint u_n_instances;
uniform uint u_n_work;            // triangles of all instances

const int TILE = 8;

struct Tile {
    VoxelTriangle shape;
    uint instance;
    uint triangle;
    ivec2 low;   // first and last column
    ivec2 high;
};

VoxelTriangle shape_of_work(uint work, out uint instance, out uint triangle)
{
    instance = instance_of_work(work, u_n_instances);
    triangle = instances[instance].first_triangle + work - instances[instance].first_work;
    uvec4 corners = triangles[triangle];
    return voxel_triangle(to_voxels(vertex_ws(instance, corners.x)), to_voxels(vertex_ws(instance, corners.y)),
                          to_voxels(vertex_ws(instance, corners.z)), u_grid_n);
}

ivec2 tiles_of(VoxelTriangle shape)
{
    return (shape.high.xy - shape.low.xy) / TILE + 1;
}

Tile tile_at(uint index)
{
    uint low = 0u, high = u_n_work;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (tile_first[middle] <= index)
            low = middle;
        else
            high = middle;
    }
    Tile tile;
    tile.shape = shape_of_work(low, tile.instance, tile.triangle);
    int local = int(index - tile_first[low]), across = tiles_of(tile.shape).x;
    tile.low = tile.shape.low.xy + TILE * ivec2(local % across, local / across);
    tile.high = min(tile.low + TILE - 1, tile.shape.high.xy);
    return tile;
}
