// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    turn the sums of each surfel into its mean position and normal.
// Formula:    x = sum_i A_i x_i / sum_i A_i
// In:         Sums
// Out:        Surfels
// Invocation: one surfel

#include "lib/layouts.glsl"
#include "lib/math.glsl"
#include "bind/grid.glsl"
#include "bind/voxel_sums.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer Surfels { Surfel surfels[]; };

uniform uint u_first;
uniform uint u_end;

// How far the outermost plane of one side lies beyond the mean position; 0 if no surface faces that way.
float beyond(uint plane, float height)
{
    return plane == 0u ? 0.0 : float(plane) / ONE - 1.0 - height;
}

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    uint at = i * uint(u_n_sums), key = sums[at + 7u];
    float area = max(float(sums[at]), 1.0);
    vec3 voxel = vec3(key & 1023u, key >> 10u & 1023u, key >> 20u & 1023u);
    vec3 inside = clamp(mean3(at + 4u, area), 0.0, 1.0), n = mean3(at + 1u, area);
    n = dot(n, n) > 0.0 ? normalize(n) : vec3(0.0, 0.0, 1.0);  // where octree/accumulate found no touch
    surfels[i].position = u_grid_low + (voxel + inside) / u_voxels_per_metre;
    surfels[i].normal = pack_unit(n);
    surfels[i].voxel = key;
    float height = dot(inside - 0.5, n);
    surfels[i].outer = packHalf2x16(vec2(beyond(sums[at + 8u], height), beyond(sums[at + 9u], -height)));
    surfels[i].area = sums[at];
}
