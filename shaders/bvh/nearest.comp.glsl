// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    for each cluster the other one near it in Morton order with which it would make the smallest box [Meister18].
// Formula:    arg min over j of (area of the box around i and j, i xor j): the pairs are ordered alike from both sides, so
//             that in every tree one pair at least chooses each other, and equal ones go by twos
// In:         Clusters: of a tree one after another, in Morton order
// Out:        Neighbours: the index of the other cluster, its own if there is none
// Invocation: one cluster

#include "lib/layouts.glsl"

const int RADIUS = 4;  // neighbours on each side: 16 make trees of mixed sizes 4 % better, no others, in three times the time

layout(local_size_x = 64) in;

layout(std430) readonly buffer Clusters { Cluster clusters[]; };
layout(std430) writeonly buffer Neighbours { uint neighbours[]; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_n_clusters;
uniform uint u_max_height;   // of a merged cluster, so that every tree stays as low as its traversal's stack
uniform bool u_take_next;    // pair by pair along the order instead, where hardly any choose each other

uint tree_of(uint i)
{
    return clusters[i].tree_height >> BVH_HEIGHT_BITS;
}

uint height_of(Cluster cluster)
{
    return cluster.tree_height & ((1u << BVH_HEIGHT_BITS) - 1u);
}

// The first cluster of the tree to which cluster i belongs.
uint first_of_tree(uint i)
{
    uint tree = tree_of(i), low = 0u, high = i;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (tree_of(middle) < tree)
            low = middle + 1u;
        else
            high = middle;
    }
    return low;
}

uint next_of(uint i)
{
    uint first = first_of_tree(i), j = first + ((i - first) ^ 1u);
    return j < u_n_clusters && tree_of(j) == tree_of(i) ? j : i;
}

uint nearest_of(uint i)
{
    Cluster own = clusters[i];
    uint tree = own.tree_height >> BVH_HEIGHT_BITS, best = i;
    float best_area = 0.0;
    uint end = min(i + uint(RADIUS) + 1u, u_n_clusters);
    for (uint j = i - min(i, uint(RADIUS)); j < end; j++) {
        Cluster other = clusters[j];
        if (j == i || other.tree_height >> BVH_HEIGHT_BITS != tree || max(height_of(own), height_of(other)) >= u_max_height)
            continue;
        vec3 size = max(own.high, other.high) - min(own.low, other.low);
        float area = dot(size, size.yzx);
        if (best == i || area < best_area || (area == best_area && (i ^ j) < (i ^ best))) {
            best = j;
            best_area = area;
        }
    }
    return best;
}

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i < u_end)
        neighbours[i] = u_take_next ? next_of(i) : nearest_of(i);
}
