// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: light of emissive triangles, which send it out on both sides, drawn from a light tree.

#include "bind/light_draw.glsl"
#include "bind/light_tree.glsl"
#include "bind/trace.glsl"
#include "lib/triangle_light.glsl"

const bool HAS_TEXTURES = false;
const bool HAS_EMITTERS = false;
const int N_EMITTER_DRAWS = 1;

uniform usamplerBuffer u_emitters;  // of Emitter, ascending in `work`
uniform uvec2 u_emitter_tree;
uniform uint u_n_emitters;

mat3 corners_from(vec3 p, uint instance, uint triangle)
{
    uvec4 corners = triangles[triangle];
    return mat3(vertex_ws(instance, corners.x) - p, vertex_ws(instance, corners.y) - p, vertex_ws(instance, corners.z) - p);
}

// One of N_EMITTER_DRAWS, without shadows.
LightDraw draw_emitter(Surface s, vec3 u)
{
    float probability;
    uint leaf = draw_leaf(u_emitter_tree, s.position, s.normal, u.z, probability);
    if (leaf == NO_LEAF)
        return NO_DRAW;
    LightNode node = light_node(u_emitter_tree.x + u_emitter_tree.y + leaf);
    uvec4 emitter = texelFetch(u_emitters, int(node.light));
    TriangleDraw draw = draw_triangle(corners_from(s.position, emitter.y, emitter.z), u.xy);
    if (draw.solid_angle == 0.0)
        return NO_DRAW;
    vec2 uv = HAS_TEXTURES ? uv_at(emitter.z, draw.bary) : vec2(0.0);
    uint material = material_of(emitter.y, emitter.z);
    vec3 L = emission_at(material, uv, HAS_TEXTURES);
    if (HAS_ALPHA)
        L *= clamp(alpha_at(material, uv, HAS_TEXTURES), 0.0, 1.0);
    float density = float(N_EMITTER_DRAWS) * probability / draw.solid_angle;
    return LightDraw(draw.wi, draw.distance, L / density, density);
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
    return float(N_EMITTER_DRAWS) * leaf_probability(u_emitter_tree, leaf, p, normal) / spread;
}
