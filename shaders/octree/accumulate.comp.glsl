// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    add what each triangle brings to each surfel, weighted by its area inside the voxel.
// Formula:    sum_i A_i x_i in fixed point: integer addition knows no order, so the sums are the same in every run
// In:         triangles, materials, octree
// Out:        Sums: per surfel area, albedo, normal, centroid in the voxel, voxel and axis, how far out the outermost planes
//             lie that face front and back, emission: SUMS words
// Invocation: one strip of columns of one triangle

#include "bind/visit_voxels.glsl"
#include "bind/octree.glsl"
#include "bind/materials.glsl"

const bool HAS_TEXTURES = false;
const bool HAS_EMISSION = false;
const int SUMS = 16;            // words a surfel, 13 without emission
const float ONE = 262144.0;     // fixed point's unit: 2^18 a voxel's face leaves room for 8192 faces in a voxel

layout(std430) buffer Sums { uint sums[]; };

uniform float u_emission_unit;  // radiance that counts as 1

void add(uint at, float value)
{
    atomicAdd(sums[at], uint(int(round(value * ONE))));  // negative numbers wrap round, as two's complement wants it
}

void visit(Strip strip, ivec3 cell)
{
    int axis = strip.shape.axis;
    ivec3 voxel = turned_back(cell, axis);
    uint at = find_surfel(voxel, axis) * uint(SUMS);
    vec4 part = clipped_part(strip.shape, cell);
    float area = max(part.w, 1.0 / ONE);
    vec2 uv = HAS_TEXTURES ? uv_at(strip.triangle, barycentrics(strip.shape, part.xyz)) : vec2(0.0);
    uint material = material_of(strip.instance, strip.triangle);
    Shading s = shading_at(material, uv, HAS_TEXTURES);
    vec3 albedo = clamp(s.base_color * (1.0 - materials[material].transmission), 0.0, 1.0);
    vec3 inside = turned_back(part.xyz - vec3(cell), axis), n = unit_normal(strip.shape);
    bool is_front = n.z * handedness(instances[strip.instance]) > 0.0;
    n = turned_back(n.z < 0.0 ? -n : n, axis);
    add(at, area);
    for (int i = 0; i < 3; i++) {
        add(at + 1u + uint(i), area * albedo[i]);
        add(at + 4u + uint(i), area * n[i]);
        add(at + 7u + uint(i), area * inside[i]);
        if (HAS_EMISSION)
            add(at + 13u + uint(i), area * max(s.emission[i], 0.0) / u_emission_unit);
    }
    sums[at + 10u] = uint(voxel.x | voxel.y << 10 | voxel.z << 20) | uint(axis) << 30u;  // the same from every writer
    float height = dot(inside - 0.5, n);
    atomicMax(sums[at + (is_front ? 11u : 12u)], uint(round((1.0 + (is_front ? height : -height)) * ONE)));
}
