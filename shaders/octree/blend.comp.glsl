// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    turn the sums of each surfel into its mean albedo and emission.
// Formula:    x = sum_i A_i x_i / sum_i A_i
// In:         Sums, Surfels
// Out:        Colors
// Invocation: one surfel

#include "lib/layouts.glsl"
#include "bind/voxel_sums.glsl"

const float MAX_ALBEDO = 0.9999;  // below 1, so that the light of endless bounces ends

layout(local_size_x = 64) in;

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) writeonly buffer Colors { SurfelColors colors[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    uint at = i * uint(u_n_sums);
    float area = max(float(surfels[i].area), 1.0);
    colors[i].albedo = clamp(mean3(at, area), 0.0, MAX_ALBEDO);
    colors[i].through = float(int(sums[at + 3u])) / area;
    colors[i].emission = u_emission_unit > 0.0 ? mean3(at + 4u, area) * u_emission_unit : vec3(0.0);
}
