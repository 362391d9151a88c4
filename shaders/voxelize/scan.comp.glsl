// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    exclusive prefix sums [Blelloch90]: each block adds up its own values, behind the sums of all blocks before it.
// In:         Values; with u_has_sums the BlockSums of all blocks but the last
// Out:        Firsts: the sum of all values before it, with u_has_sums in Values itself if need be; Total: the sum of all
// Invocation: eight neighbouring values; one workgroup a block

#include "voxelize/scan_values.glsl"

uniform bool u_has_sums;  // else each block adds up all values before it, while they are too few for another dispatch

layout(std430) readonly buffer BlockSums { uint block_sums[]; };
layout(std430) writeonly buffer Firsts { uint firsts[]; };
layout(std430) writeonly buffer Total { uint total[]; };

shared uint sums[256];
shared uint before;

void main()
{
    uint block = block_of_workgroup(), lane = gl_LocalInvocationID.x;
    uint start = block * 2048u + lane * 8u, own[8], sum = 0u, blocks = 0u;
    for (uint i = 0u; i < 8u; i++) {
        own[i] = sum;
        sum += value_at(start + i);
    }
    sums[lane] = sum;
    if (lane == 0u)
        before = 0u;
    barrier();
    for (uint i = lane; i < (u_has_sums ? block : block * 2048u); i += 256u)
        blocks += u_has_sums ? block_sums[i] : value_at(i);
    atomicAdd(before, blocks);
    for (uint reach = 1u; reach < 256u; reach *= 2u) {
        uint left = lane >= reach ? sums[lane - reach] : 0u;
        barrier();
        sums[lane] += left;
        barrier();
    }
    for (uint i = 0u; i < 8u; i++)
        if (start + i < u_n_values)
            firsts[start + i] = before + sums[lane] - sum + own[i];
    if (start < u_n_values && start + 8u >= u_n_values)
        total[0] = before + sums[lane];
}
