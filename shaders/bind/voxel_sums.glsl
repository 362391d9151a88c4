// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: sums of what triangles bring to a voxel or surfel, and the means over their weights. Fixed point: integer
// addition knows no order, so the sums are the same in every run.

const float ONE = 262144.0;  // fixed point's unit: 2^18 a voxel's face leaves room for 8192 faces in a voxel

layout(std430) buffer Sums { uint sums[]; };

uniform int u_n_sums;           // words of each
uniform float u_emission_unit;  // radiance that counts as 1; 0 if nothing sends out light

void add(uint at, float value)
{
    atomicAdd(sums[at], uint(int(round(value * ONE))));  // negative numbers wrap round, as two's complement wants it
}

void add(uint at, vec3 value)
{
    for (int i = 0; i < 3; i++)
        add(at + uint(i), value[i]);
}

vec3 mean3(uint at, float weight)
{
    return vec3(int(sums[at]), int(sums[at + 1u]), int(sums[at + 2u])) / weight;
}
