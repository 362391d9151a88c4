// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what one triangle brings to one voxel.

#include "bind/visit_voxels.glsl"
#include "bind/baked.glsl"
#include "bind/principled.glsl"

const float LEAST = 1.0 / 8192.0;  // voxel faces that a mere touch weighs: where there is nothing else, means within 1 / 64

struct Part {
    float area;     // inside the voxel; its voxel's face is 1
    float weight;   // that area, or LEAST
    vec3 middle;    // centroid, voxel units, axes turned as in lib/triangle_box.glsl
    vec3 normal;    // unit, axes turned
    vec3 albedo;
    vec3 emission;  // radiance
    float alpha;
};

Part part_of(Strip strip, ivec3 cell)
{
    vec4 clipped = clipped_part(strip.shape, cell);
    Material m = materials[strip.material];
    vec2 bary = barycentrics(strip.shape, clipped.xyz);
    uint at = baked_at(strip.instance, strip.triangle, bary);
    if (at != NOT_BAKED) {
        Cell c = unpacked_cell(texelFetch(u_baked, int(at)));
        return Part(clipped.w, max(clipped.w, LEAST), clipped.xyz, unit_normal(strip.shape), c.albedo, c.emission, c.opacity);
    }
    Shading s = shading_at(m, uv_at(strip.triangle, bary));
    vec3 albedo = m.program == PROGRAM_MATTE ? clamp(s.base_color, 0.0, 1.0) : mean_albedo(m, s);
    return Part(clipped.w, max(clipped.w, LEAST), clipped.xyz, unit_normal(strip.shape),
                albedo, max(s.emission, 0.0), clamp(s.alpha, 0.0, 1.0));
}
