// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: which voxels hold a surface: one bit each, 4x4x4 voxels a block of two words; and rays through them.

#include "bind/grid.glsl"

layout(std430) buffer Occupancy { uint occupancy[]; };

// Word and bit of a voxel.
uvec2 occupancy_address(ivec3 v)
{
    ivec3 block = v >> 2, cell = v & 3;
    int n_blocks = u_grid_n >> 2;
    int bit = (cell.z * 4 + cell.y) * 4 + cell.x;
    return uvec2(uint(((block.z * n_blocks + block.y) * n_blocks + block.x) * 2 + (bit >> 5)), uint(bit & 31));
}

// The voxel of bit `bit` of word `word`.
ivec3 occupancy_voxel(uint word, uint bit)
{
    int n_blocks = u_grid_n >> 2, block = int(word >> 1u), cell = int((word & 1u) * 32u + bit);
    return ivec3(block % n_blocks, block / n_blocks % n_blocks, block / (n_blocks * n_blocks)) * 4
         + ivec3(cell & 3, cell >> 2 & 3, cell >> 4);
}

bool is_occupied(ivec3 v)
{
    uvec2 address = occupancy_address(v);
    return (occupancy[address.x] >> address.y & 1u) != 0u;
}

// Distance along the ray at which it leaves the box; inv_d may be infinite.
float box_exit(vec3 o, vec3 inv_d, vec3 low, vec3 high)
{
    vec3 t = max((low - o) * inv_d, (high - o) * inv_d);
    return min(min(t.x, t.y), t.z);
}

// Does an occupied voxel lie on the ray from o along unit d within t_max? Voxel units. Empty blocks are crossed at once.
bool is_blocked(vec3 o, vec3 d, float t_max)
{
    vec3 inv_d = 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
    float t = 0.0;
    while (t < t_max) {
        ivec3 v = ivec3(floor(o + d * t));
        if (any(lessThan(v, ivec3(0))) || any(greaterThanEqual(v, ivec3(u_grid_n))))
            return false;
        uvec2 address = occupancy_address(v);
        uint block = address.x & ~1u;
        if ((occupancy[block] | occupancy[block + 1u]) == 0u) {
            vec3 low = vec3(v & ~3);
            t = box_exit(o, inv_d, low, low + 4.0) + 1e-3;
        } else if ((occupancy[address.x] >> address.y & 1u) != 0u) {
            return true;
        } else {
            t = box_exit(o, inv_d, vec3(v), vec3(v) + 1.0) + 1e-3;
        }
    }
    return false;
}
