// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: voxelization's work, cut evenly: one strip is at most COLUMNS columns of one triangle's rectangle, row by row, so
// that a wall of the room keeps as many invocations busy as a thousand small triangles.

#include "bind/geometry.glsl"
#include "bind/grid.glsl"
#include "lib/triangle_box.glsl"

layout(std430) buffer StripFirst { uint strip_first[]; };  // strips of all triangles before this one

uniform uint u_n_instances;
uniform uint u_n_work;            // triangles of all instances

const int COLUMNS = 9;  // three by three: most triangles of a fine mesh are one strip

struct Strip {
    VoxelTriangle shape;
    uint instance;
    uint triangle;
    uint material;
    int first;   // first column of the rectangle, counted row by row, and the one after the last
    int end;
};

VoxelTriangle shape_of_work(uint work, out uint instance, out uint triangle)
{
    instance = instance_of_work(work, u_n_instances);
    triangle = instances[instance].first_triangle + work - instances[instance].first_work;
    uvec4 corners = triangles[triangle];
    return voxel_triangle(to_voxels(vertex_ws(instance, corners.x)), to_voxels(vertex_ws(instance, corners.y)),
                          to_voxels(vertex_ws(instance, corners.z)), u_grid_n);
}

int columns_of(VoxelTriangle shape)
{
    ivec2 size = shape.high.xy - shape.low.xy + 1;
    return size.x * size.y;
}

Strip strip_at(uint index)
{
    uint low = 0u, high = u_n_work;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (strip_first[middle] <= index)
            low = middle;
        else
            high = middle;
    }
    Strip strip;
    strip.shape = shape_of_work(low, strip.instance, strip.triangle);
    strip.material = material_of(strip.instance, strip.triangle);
    strip.first = int(index - strip_first[low]) * COLUMNS;
    strip.end = min(strip.first + COLUMNS, columns_of(strip.shape));
    return strip;
}
