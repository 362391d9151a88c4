// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    exclusive prefix sums inside blocks of 2048 counts; voxelize/scan_add joins the blocks [Blelloch90].
// In:         Counts
// Out:        Counts: the sum of all before it in its block; BlockSums: the sum of each block
// Invocation: eight neighbouring counts; one workgroup a block

layout(local_size_x = 256) in;

layout(std430) buffer Counts { uint counts[]; };
layout(std430) writeonly buffer BlockSums { uint block_sums[]; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_n_counts;

shared uint sums[256];

void main()
{
    uint block = u_first / 256u + gl_WorkGroupID.x, lane = gl_LocalInvocationID.x;
    uint start = block * 2048u + lane * 8u, own[8], total = 0u;
    for (uint i = 0u; i < 8u; i++) {
        own[i] = total;
        total += start + i < u_n_counts ? counts[start + i] : 0u;
    }
    sums[lane] = total;
    barrier();
    for (uint reach = 1u; reach < 256u; reach *= 2u) {
        uint before = lane >= reach ? sums[lane - reach] : 0u;
        barrier();
        sums[lane] += before;
        barrier();
    }
    for (uint i = 0u; i < 8u; i++)
        if (start + i < u_n_counts)
            counts[start + i] = own[i] + sums[lane] - total;
    if (lane == 255u)
        block_sums[block] = sums[255];
}
