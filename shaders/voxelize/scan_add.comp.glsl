// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    add to each count the sum of all blocks before its own; the second half of voxelize/scan.
// In:         BlockSums, scanned
// Out:        Counts
// Invocation: one count

layout(local_size_x = 64) in;

layout(std430) buffer Counts { uint counts[]; };
layout(std430) readonly buffer BlockSums { uint block_sums[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i < u_end)
        counts[i] += block_sums[i / 2048u];
}
