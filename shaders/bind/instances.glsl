// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a ray needs of the scene's triangles beside the trees of boxes: whose they are, and where on an image.

#include "lib/layouts.glsl"

layout(std430) readonly buffer Instances { Instance instances[]; };
layout(std430) readonly buffer Triangles { uvec4 triangles[]; };          // three vertices, material slot
layout(std430) readonly buffer CornerUvs { vec2 corner_uvs[]; };          // three a triangle; one entry if unused
layout(std430) readonly buffer SlotMaterials { uint slot_materials[]; };

uint material_of(uint instance, uint triangle)
{
    return slot_materials[instances[instance].first_slot + triangles[triangle].w];
}

// Texture coordinates at barycentrics (of the second and third corner).
vec2 uv_at(uint triangle, vec2 bary)
{
    if (corner_uvs.length() < 3)
        return vec2(0.0);
    vec2 a = corner_uvs[3u * triangle], b = corner_uvs[3u * triangle + 1u], c = corner_uvs[3u * triangle + 2u];
    return a + bary.x * (b - a) + bary.y * (c - a);
}
