// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: points on emissive triangles, with what their material sends out.

#include "bind/emitters.glsl"
#include "bind/emission.glsl"

// Draw k of u_n_emitter_draws, without shadows.
LightDraw draw_emitter(int k, vec3 p, vec3 normal, uint sample_index, uint seed)
{
    vec3 u = point_and_choice(sample_index * uint(u_n_emitter_draws) + uint(k), hash(seed + 11u));
    float probability;
    uint leaf = draw_leaf(u_emitter_tree, p, normal, u.z, probability);
    if (leaf == NO_LEAF)
        return NO_DRAW;
    LightNode node = light_node(u_emitter_tree.x + u_emitter_tree.y + leaf);
    uvec4 emitter = texelFetch(u_emitters, int(node.light));
    TriangleDraw draw = draw_triangle(corners_from(p, emitter.y, emitter.z), u.xy);
    if (draw.solid_angle == 0.0)
        return NO_DRAW;
    vec3 L = emission_of(emitter.y, emitter.z, draw.bary) * cover_of(emitter.y, emitter.z, draw.bary);
    float density = float(u_n_emitter_draws) * probability / draw.solid_angle;
    return LightDraw(draw.wi, draw.distance, L / density, density);
}
