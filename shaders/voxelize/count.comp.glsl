// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    how many strips of columns each triangle's voxelization takes (bind/voxel_work.glsl).
// In:         triangles of all instances
// Out:        StripFirst: the count, which voxelize/scan turns into the first strip
// Invocation: one triangle of one instance

#include "bind/voxel_work.glsl"

layout(local_size_x = 64) in;

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint work = u_first + gl_GlobalInvocationID.x, instance, triangle;
    if (work >= u_end)
        return;
    int columns = columns_of(shape_of_work(work, instance, triangle));
    strip_first[work] = uint((columns + COLUMNS - 1) / COLUMNS);
}
