// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    a round of merging: pairs that chose each other become a node and one cluster, all others stay [Meister18].
// In:         Clusters, Neighbours, Places: clusters left before each
// Out:        Merged: the clusters that are left; BvhNodes: from u_first_node on, in the order of the pairs
// Invocation: one cluster

#include "lib/layouts.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer Clusters { Cluster clusters[]; };
layout(std430) readonly buffer Neighbours { uint neighbours[]; };
layout(std430) readonly buffer Places { uint places[]; };
layout(std430) writeonly buffer Merged { Cluster merged[]; };
layout(std430) writeonly buffer BvhNodes { BvhNode bvh_nodes[]; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_first_node;

Cluster merged_of(Cluster a, Cluster b, uint node)
{
    bvh_nodes[node] = BvhNode(a.low, a.reference, a.high, b.reference, b.low, b.high);
    uint tree_height = max(a.tree_height, b.tree_height) + 1u;  // of the same tree: the higher one
    return Cluster(min(a.low, b.low), node, max(a.high, b.high), tree_height);
}

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    uint other = neighbours[i];
    bool is_pair = other != i && neighbours[other] == i;
    if (is_pair && other < i)
        return;
    Cluster cluster = clusters[i];
    if (is_pair)
        cluster = merged_of(cluster, clusters[other], u_first_node + other - places[other]);
    merged[places[i]] = cluster;
}
