// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    add what each triangle brings to each voxel that it touches, weighted by its area inside the voxel, so that
//             tessellation and overlap change nothing.
// Formula:    sum_i A_i x_i in fixed point: integer addition knows no order, so the sums are the same in every run
// In:         triangles, materials, Occupancy, VoxelFirst (number of a word's first voxel)
// Out:        Sums: per voxel area, albedo, normal, covered area, emission, SUMS words in this order
// Invocation: one strip of columns of one triangle

#include "bind/visit_voxels.glsl"
#include "bind/voxels.glsl"
#include "bind/materials.glsl"

const bool HAS_TEXTURES = false;
const bool HAS_EMISSION = false;
const int SUMS = 11;            // words a voxel, 8 without emission
const float ONE = 262144.0;     // fixed point's unit: 2^18 a voxel's face leaves 8191 faces to a voxel's signed sums

layout(std430) buffer Sums { uint sums[]; };
layout(std430) readonly buffer VoxelFirst { uint voxel_first[]; };

uniform float u_emission_unit;  // radiance that counts as 1

void add(uint at, float value)
{
    atomicAdd(sums[at], uint(int(round(value * ONE))));  // negative numbers wrap round, as two's complement wants it
}

void visit(Strip strip, ivec3 cell)
{
    uvec2 address = occupancy_address(turned_back(cell, strip.shape.axis));
    uint below = occupancy[address.x] & ((1u << address.y) - 1u);
    uint at = (voxel_first[address.x] + uint(bitCount(below))) * uint(SUMS);
    vec4 part = clipped_part(strip.shape, cell);
    float area = max(part.w, 1.0 / ONE);
    vec2 uv = HAS_TEXTURES ? uv_at(strip.triangle, barycentrics(strip.shape, part.xyz)) : vec2(0.0);
    uint material = material_of(strip.instance, strip.triangle);
    Shading s = shading_at(material, uv, HAS_TEXTURES);
    vec3 n = unit_normal(strip.shape);
    float facing = abs(n.z);
    n = turned_back(n, strip.shape.axis);
    vec3 albedo = clamp(s.base_color * (1.0 - materials[material].transmission), 0.0, 1.0);
    add(at, area);
    for (int i = 0; i < 3; i++) {
        add(at + 1u + uint(i), area * albedo[i]);
        add(at + 4u + uint(i), area * n[i]);
    }
    add(at + 7u, area * facing * clamp(s.alpha, 0.0, 1.0));
    if (HAS_EMISSION)
        for (int i = 0; i < 3; i++)
            add(at + 8u + uint(i), area * max(s.emission[i], 0.0) / u_emission_unit);
}
