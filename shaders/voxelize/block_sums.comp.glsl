// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the sum of each block of values, for voxelize/scan.
// In:         Values
// Out:        BlockSums
// Invocation: eight of a block's values; one workgroup a block

#include "voxelize/scan_values.glsl"

layout(std430) writeonly buffer BlockSums { uint block_sums[]; };

shared uint sum;

void main()
{
    uint block = block_of_workgroup(), lane = gl_LocalInvocationID.x, own = 0u;
    if (lane == 0u)
        sum = 0u;
    barrier();
    for (uint i = 0u; i < 8u; i++)
        own += value_at(block * 2048u + i * 256u + lane);
    atomicAdd(sum, own);
    barrier();
    if (lane == 0u)
        block_sums[block] = sum;
}
