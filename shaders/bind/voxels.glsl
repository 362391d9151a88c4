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

bool is_occupied(ivec3 v)
{
    uvec2 address = occupancy_address(v);
    return (occupancy[address.x] >> address.y & 1u) != 0u;
}

// Does an occupied voxel lie on the ray from o along unit d within t_max? Voxel units. Empty blocks are crossed at once.
// The ray walks in whole cells [Amanatides87]: a position that is rounded back over the border just crossed would leave
// it there for ever.
bool is_blocked(vec3 o, vec3 d, float t_max)
{
    vec3 inv_d = 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
    ivec3 v = ivec3(floor(o));
    float t = 0.0;
    while (t < t_max && all(greaterThanEqual(v, ivec3(0))) && all(lessThan(v, ivec3(u_grid_n)))) {
        if (is_occupied(v))
            return true;
        uint block = occupancy_address(v).x & ~1u;
        bool is_empty = (occupancy[block] | occupancy[block + 1u]) == 0u;
        ivec3 low = is_empty ? v & ~3 : v, high = low + (is_empty ? 4 : 1);
        vec3 leave = max((vec3(low) - o) * inv_d, (vec3(high) - o) * inv_d);
        int axis = leave.x < leave.y && leave.x < leave.z ? 0 : leave.y < leave.z ? 1 : 2;
        t = leave[axis];
        v = clamp(ivec3(floor(o + d * t)), low, high - 1);
        v[axis] = inv_d[axis] > 0.0 ? high[axis] : low[axis] - 1;
    }
    return false;
}
