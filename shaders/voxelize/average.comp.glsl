// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    turn the sums of each occupied voxel into its mean albedo, normal, emission and coverage.
// Formula:    x = sum_i A_i x_i / sum_i A_i; coverage = min(1, sum_i A_i max|n_i| alpha_i), the filled part of a voxel's face
// In:         Occupancy, VoxelFirst, Sums
// Out:        Voxels, in the order of their bits
// Invocation: one word of the occupancy

#include "lib/layouts.glsl"
#include "lib/math.glsl"
#include "bind/voxels.glsl"
#include "bind/voxel_sums.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer VoxelFirst { uint voxel_first[]; };
layout(std430) writeonly buffer Voxels { Voxel voxels[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint word = u_first + gl_GlobalInvocationID.x;
    if (word >= u_end)
        return;
    uint bits = occupancy[word], i = voxel_first[word];
    for (; bits != 0u; bits &= bits - 1u, i++) {
        uint at = i * uint(SUMS);
        float area = max(float(sums[at]), 1.0);
        vec3 normal = mean3(at + 4u, area);
        uvec3 v = uvec3(occupancy_voxel(word, uint(findLSB(bits))));
        float coverage = clamp(float(sums[at + 7u]) / ONE, 0.0, 1.0);
        voxels[i].voxel = v.x | v.y << 10u | v.z << 20u;
        voxels[i].albedo_coverage = packUnorm4x8(vec4(mean3(at + 1u, area), coverage));
        voxels[i].normal = dot(normal, normal) > 1e-2 ? pack_unit(normal) : NO_NORMAL;
        voxels[i].emission = HAS_EMISSION ? mean3(at + 8u, area) * u_emission_unit : vec3(0.0);
    }
}
