// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: emissive triangles, which send out light on both sides, as lights that are drawn from a tree.

#include "bind/draws.glsl"
#include "bind/geometry.glsl"
#include "bind/light_tree.glsl"
#include "lib/triangle_light.glsl"

uniform usamplerBuffer u_emitters;  // of Emitter, ascending in `work`
uniform uvec2 u_emitter_tree;
uniform uint u_n_emitters;

mat3 corners_from(vec3 p, uint instance, uint triangle)
{
    uvec4 corners = triangles[triangle];
    return mat3(vertex_ws(instance, corners.x) - p, vertex_ws(instance, corners.y) - p, vertex_ws(instance, corners.z) - p);
}

// The index among emitters of a triangle, or NO_LEAF if it is none.
uint find_emitter(uint instance, uint triangle)
{
    uint work = instances[instance].first_work + triangle - instances[instance].first_triangle;
    uint low = 0u, high = u_n_emitters;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (texelFetch(u_emitters, int(middle)).x < work)
            low = middle + 1u;
        else
            high = middle;
    }
    return low < u_n_emitters && texelFetch(u_emitters, int(low)).x == work ? low : NO_LEAF;
}

// [sr^-1] with which a surface with that normal draws unit d towards an emissive triangle, all draws together.
float emitter_density(vec3 p, vec3 normal, vec3 d, uint instance, uint triangle)
{
    uint i = find_emitter(instance, triangle);
    float spread = i == NO_LEAF ? 0.0 : spread_towards(corners_from(p, instance, triangle), d);
    if (spread == 0.0)
        return 0.0;
    uint leaf = texelFetch(u_emitters, int(i)).w;
    return float(u_n_emitter_draws) * leaf_probability(u_emitter_tree, leaf, p, normal) / spread;
}

// Share of the emission that a ray from p finds there, drawn along d with pdf_ray [sr^-1]: draws find it too.
float emitter_weight(vec3 p, vec3 normal, vec3 d, float pdf_ray, uint instance, uint triangle)
{
    vec3 towards = dot(normal, d) < 0.0 ? -normal : normal;
    return balance(pdf_ray, emitter_density(p, towards, d, instance, triangle));
}
