// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    turn the sums of each surfel into its mean position, normal, albedo and emission.
// Formula:    x = sum_i A_i x_i / sum_i A_i
// In:         Sums
// Out:        Surfels
// Invocation: one surfel

#include "lib/layouts.glsl"
#include "lib/math.glsl"
#include "bind/grid.glsl"

const bool HAS_EMISSION = false;
const int SUMS = 14;
const float MAX_ALBEDO = 0.9999;  // below 1, so that the light of endless bounces ends

layout(local_size_x = 64) in;

layout(std430) readonly buffer Sums { uint sums[]; };
layout(std430) writeonly buffer Surfels { Surfel surfels[]; };

uniform uint u_first;
uniform uint u_end;
uniform float u_emission_unit;

vec3 mean3(uint at, float area)
{
    return vec3(int(sums[at]), int(sums[at + 1u]), int(sums[at + 2u])) / area;
}

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    uint at = i * uint(SUMS), key = sums[at + 10u];
    float area = float(sums[at]);
    vec3 voxel = vec3(key & 1023u, key >> 10u & 1023u, key >> 20u & 1023u);
    surfels[i].position = u_grid_low + (voxel + clamp(mean3(at + 7u, area), 0.0, 1.0)) / u_voxels_per_metre;
    surfels[i].normal = pack_unit(normalize(mean3(at + 4u, area)));
    surfels[i].albedo = clamp(mean3(at + 1u, area), 0.0, MAX_ALBEDO);
    surfels[i].emission = HAS_EMISSION ? mean3(at + 11u, area) * u_emission_unit : vec3(0.0);
    surfels[i].voxel = key & 0x3fffffffu;
    surfels[i].axis = key >> 30u;
}
