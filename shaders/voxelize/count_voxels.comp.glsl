// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    how many occupied voxels each word of the occupancy holds.
// In:         Occupancy
// Out:        VoxelFirst: the count, which voxelize/scan turns into the number of the word's first voxel
// Invocation: one word

#include "bind/voxels.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer VoxelFirst { uint voxel_first[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint word = u_first + gl_GlobalInvocationID.x;
    if (word < u_end)
        voxel_first[word] = uint(bitCount(occupancy[word]));
}
