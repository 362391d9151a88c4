// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the sparse voxel octree, two levels a node: a node covers 4x4x4 children with a 64-bit mask, and only occupied
// nodes exist. The top masks lie in a grid of cells of 16^3 voxels; each of their bits is a node of 4^3 voxels. A node has a
// mask for each axis: a bit is a surfel, the surfaces of that voxel whose normals are widest along that axis.

#include "bind/grid.glsl"

layout(std430) buffer Octree { uint octree[]; };  // top masks, nodes before each of their words, node masks, surfels before

uniform uint u_n_top_words;   // two a cell
uniform uint u_n_node_words;  // six a node: two an axis

const uint NOTHING = 0xffffffffu;

// Word and bit of child `at` (0 to 3 along each axis) among 64.
uvec2 child_bit(ivec3 at)
{
    int bit = (at.z * 4 + at.y) * 4 + at.x;
    return uvec2(bit >> 5, bit & 31);
}

// Word and bit of the node that holds a voxel of the grid.
uvec2 node_bit(ivec3 voxel)
{
    ivec3 cell = voxel >> 4;
    int n_cells = u_grid_n >> 4;
    uvec2 bit = child_bit((voxel >> 2) & 3);
    return uvec2(uint((cell.z * n_cells + cell.y) * n_cells + cell.x) * 2u + bit.x, bit.y);
}

// Number of the node that holds a voxel, or NOTHING.
uint find_node(ivec3 voxel)
{
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(u_grid_n))))
        return NOTHING;
    uvec2 bit = node_bit(voxel);
    uint mask = octree[bit.x];
    if ((mask >> bit.y & 1u) == 0u)
        return NOTHING;
    return octree[u_n_top_words + bit.x] + uint(bitCount(mask & ((1u << bit.y) - 1u)));
}

// Word and bit of a surfel in a node's masks.
uvec2 surfel_bit(uint node, ivec3 voxel, int axis)
{
    uvec2 bit = child_bit(voxel & 3);
    return uvec2(2u * u_n_top_words + (node * 3u + uint(axis)) * 2u + bit.x, bit.y);
}

uint find_surfel(ivec3 voxel, int axis)
{
    uint node = find_node(voxel);
    if (node == NOTHING)
        return NOTHING;
    uvec2 bit = surfel_bit(node, voxel, axis);
    uint mask = octree[bit.x];
    if ((mask >> bit.y & 1u) == 0u)
        return NOTHING;
    return octree[bit.x + u_n_node_words] + uint(bitCount(mask & ((1u << bit.y) - 1u)));
}

int widest_axis(vec3 n)
{
    vec3 size = abs(n);
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// The surfel at a surface point. Rounding may put the point into the voxel beside, or a slanted normal onto another axis:
// then the nearest thing to it is taken. A loop whose end compilers do not know: they would write out all of its turns.
uint surfel_at(vec3 p_vx, vec3 n)
{
    int axis = widest_axis(n), n_tries = u_n_node_words > 0u ? 5 : 0;
    uint surfel = NOTHING;
    for (int i = 0; i < n_tries && surfel == NOTHING; i++) {
        vec3 aside = i < 3 ? vec3(0.0) : i == 3 ? -0.01 * n : 0.01 * n;
        surfel = find_surfel(ivec3(floor(p_vx + aside)), i < 3 ? (axis + i) % 3 : axis);
    }
    return surfel;
}
