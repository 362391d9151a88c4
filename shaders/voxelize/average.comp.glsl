// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    turn the sums of each occupied voxel into its mean albedo, normal, emission and coverage.
// Formula:    x = sum_i A_i x_i / sum_i A_i; coverage = min(1, sum_i A_i max|n_i| alpha_i), the filled part of a voxel's face
// In:         Sums
// Out:        Voxels
// Invocation: one occupied voxel

#include "lib/layouts.glsl"
#include "lib/math.glsl"
#include "bind/voxel_sums.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer Voxels { Voxel voxels[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    uint at = i * uint(u_n_sums);
    float area = max(float(sums[at]), 1.0);
    vec3 normal = mean3(at + 4u, area);
    float coverage = clamp(float(sums[at + 7u]) / ONE, 0.0, 1.0);
    voxels[i].voxel = sums[at + 8u];
    voxels[i].albedo_coverage = packUnorm4x8(vec4(mean3(at + 1u, area), coverage));
    voxels[i].normal = dot(normal, normal) > 1e-2 ? pack_unit(normal) : NO_NORMAL;
    voxels[i].emission = u_emission_unit > 0.0 ? mean3(at + 9u, area) * u_emission_unit : vec3(0.0);
}
