// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    which clusters are left after a round of merging: all but the second ones of pairs that chose each other.
// In:         Neighbours
// Out:        Places: 1 for a cluster that is left, which voxelize/scan turns into its place in the next round
// Invocation: one cluster

layout(local_size_x = 64) in;

layout(std430) readonly buffer Neighbours { uint neighbours[]; };
layout(std430) writeonly buffer Places { uint places[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    uint other = neighbours[i];
    places[i] = other < i && neighbours[other] == i ? 0u : 1u;
}
