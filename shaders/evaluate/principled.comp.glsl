// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    points whose material is the Principled BSDF with all that it has here, and images.
// In:         Wave: hits; triangles, materials, images
// Out:        Wave: points, and lobes where there are any
// Invocation: one hit

#include "bind/lobes.glsl"
#include "bind/principled.glsl"
#include "evaluate/hit.glsl"
#include "evaluate/shaded.glsl"

uniform bool u_takes_all;   // whether it fills in all points but those of trees

bool is_ours(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    if (!is_surface(hit))
        return u_takes_all;
    uint program = materials[material_of(hit.instance, hit.triangle)].program;
    return program == PROGRAM_PRINCIPLED || (u_takes_all && program < PROGRAM_TREE);
}

void evaluate(uint slot)
{
    Hit hit = get_hit(u_set, slot);
    if (!is_surface(hit)) {
        put_point(u_set, slot, no_point(hit));
        return;
    }
    Material m = materials[material_of(hit.instance, hit.triangle)];
    vec3 wo = -hit.direction;
    Seen seen = seen_at(hit.instance, hit.triangle, hit.bary, wo);
    add_uv(seen, hit.instance, hit.triangle, hit.bary);
    vec3 normal = facing(mapped_normal(m, seen.uv, seen.surface.normal, seen.tangent, seen.bitangent), wo);
    Shading shading = shading_at(m, seen.uv);
    Bsdf b = principled(m, shading, dot(normal, wo), seen.is_back);
    Point p = point_of(hit, seen.surface, normal);
    p.diffuse = b.diffuse;
    p.emission = shading.emission;
    put_shaded(slot, p, b);
}
