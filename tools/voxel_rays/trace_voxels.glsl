// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: rays through the octree's voxels instead of the triangles: the nearest surfel on a ray. Empty blocks of 16, 8, 4
// and 2 voxels a side are crossed in one step; the ray walks in whole cells [Amanatides87].

#include "bind/cache.glsl"

const bool PLANES = false;  // a surfel is hit where the ray meets its plane inside its voxel; if not, at its voxel's faces

const float BEYOND = 0.25;  // voxels by which a plane reaches out of its voxel along the ray, over the gap to the next one

struct VoxelHit {
    float t;  // voxels
    uint surfel;
};

// The eight children of the 2x2x2 block around child `at` that lie in one word of a mask of 4x4x4.
uint block_mask(ivec3 at)
{
    return 0x00330033u << ((at.x & 2) + (at.y & 2) * 4);
}

// Size of the largest empty block around voxel v in powers of two, or 0 if v holds a surface: then `node` is its node.
int empty_size(ivec3 v, out uint node)
{
    ivec3 cell = v >> 4, at = (v >> 2) & 3;
    int n_cells = u_grid_n >> 4;
    uint word = uint((cell.z * n_cells + cell.y) * n_cells + cell.x) * 2u;
    uvec2 bit = child_bit(at);
    uint mask = octree[word + bit.x];
    node = NOTHING;
    if ((mask >> bit.y & 1u) == 0u) {
        if ((mask & block_mask(at)) != 0u)
            return 4;
        return (mask | octree[word + 1u - bit.x]) == 0u ? 16 : 8;
    }
    node = octree[u_n_top_words + word + bit.x] + uint(bitCount(mask & ((1u << bit.y) - 1u)));
    bit = child_bit(v & 3);
    uint first = 2u * u_n_top_words + node * 6u + bit.x;
    mask = octree[first] | octree[first + 2u] | octree[first + 4u];
    if ((mask >> bit.y & 1u) != 0u)
        return 0;
    return (mask & block_mask(v & 3)) == 0u ? 2 : 1;
}

uint surfel_of(uint node, ivec3 v, int axis)
{
    uvec2 bit = surfel_bit(node, v, axis);
    uint mask = octree[bit.x];
    if ((mask >> bit.y & 1u) == 0u)
        return NOTHING;
    return octree[bit.x + u_n_node_words] + uint(bitCount(mask & ((1u << bit.y) - 1u)));
}

// The surfel of voxel v that faces the ray most, as a face of the voxel; or the nearest whose plane the ray meets in it.
void meet_surfels(uint node, ivec3 v, vec3 o, vec3 d, float enter, float leave, inout VoxelHit hit)
{
    float most = -1.0;
    for (int axis = 0; axis < 3; axis++) {
        uint s = surfel_of(node, v, axis);
        if (s == NOTHING)
            continue;
        if (!PLANES && abs(d[axis]) > most) {
            most = abs(d[axis]);
            hit = VoxelHit(enter, s);
        }
        if (PLANES) {
            vec3 n = unpack_unit(surfels[s].normal);
            float t = dot(to_voxels(surfels[s].position) - o, n) / dot(d, n);
            if (t > max(enter - BEYOND, 0.0) && t < min(leave + BEYOND, hit.t))
                hit = VoxelHit(t, s);
        }
    }
}

// The nearest surfel on the ray from o along unit d, in voxels, after t_min; false if there is none.
bool trace_voxels(vec3 o, vec3 d, float t_min, out VoxelHit hit)
{
    vec3 inv_d = 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
    hit = VoxelHit(INFINITE, NOTHING);
    float t = t_min;
    ivec3 v = ivec3(floor(o + d * t));
    while (hit.surfel == NOTHING && all(greaterThanEqual(v, ivec3(0))) && all(lessThan(v, ivec3(u_grid_n)))) {
        uint node;
        int size = empty_size(v, node), side = max(size, 1);
        ivec3 low = v & ~(side - 1), high = low + side;
        vec3 exits = max((vec3(low) - o) * inv_d, (vec3(high) - o) * inv_d);
        int axis = exits.x < exits.y && exits.x < exits.z ? 0 : exits.y < exits.z ? 1 : 2;
        if (size == 0)
            meet_surfels(node, v, o, d, t, exits[axis], hit);
        t = exits[axis];
        v = clamp(ivec3(floor(o + d * t)), low, high - 1);
        v[axis] = inv_d[axis] > 0.0 ? high[axis] : low[axis] - 1;
    }
    return hit.surfel != NOTHING;
}
