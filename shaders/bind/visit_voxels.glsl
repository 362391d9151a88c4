// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the entry point of passes over all voxels that the triangles touch. One invocation a strip; whoever includes
// this says in `visit` what to do with a voxel.

#include "bind/voxel_work.glsl"

layout(local_size_x = 64) in;

uniform uint u_first;
uniform uint u_end;

// The strip's triangle touches `cell`, axes turned as in lib/triangle_box.glsl.
void visit(Strip strip, ivec3 cell);

// The next cell that the triangle touches; at first `cell` lies above `top` and `next` is the strip's first column. Apart
// from `visit`, so that neighbouring invocations find their cells first and then visit them together.
bool find_cell(Strip strip, inout int next, inout ivec3 cell, inout int top)
{
    int across = strip.shape.high.x - strip.shape.low.x + 1;
    while (true) {
        cell.z++;
        while (cell.z > top) {
            if (next == strip.end)
                return false;
            cell.xy = strip.shape.low.xy + ivec2(next % across, next / across);
            next++;
            ivec2 range = column_range(strip.shape, cell.xy);
            cell.z = range.x;
            top = touches_column(strip.shape, cell.xy) ? range.y : range.x - 1;
        }
        if (touches_cell(strip.shape, cell))
            return true;
    }
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    if (index >= u_end)
        return;
    Strip strip = strip_at(index);
    ivec3 cell = ivec3(0);
    int next = strip.first, top = 0;
    while (find_cell(strip, next, cell, top))
        visit(strip, cell);
}
