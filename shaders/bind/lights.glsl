// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: light that is drawn at a point, with traced shadows: of lamps and of the world. That of emissive triangles is
// drawn before (lights/draw), since it needs their materials.

#include "bind/lamp_tables.glsl"
#include "bind/light_tree.glsl"
#include "bind/sky.glsl"
#include "bind/trace.glsl"
#include "lib/surface.glsl"

const float SHADOW_END = 0.9999;  // of the way: the light may touch a surface
const float BEFORE = 2e-6;        // of the scene: a lamp that is a surface must not hide itself, as wrong as its place may be

layout(std430) readonly buffer Lights { Light lights[]; };

uniform uvec2 u_lamp_tree;  // its first node, its number of leaves

// Draw k of lamps, without its shadow; casts_shadow: whether it has one.
LightDraw draw_lamp(int k, int n_tree, Surface s, uint sample_index, uint seed, out bool casts_shadow)
{
    uint lamp = uint(k);
    float probability = 1.0;
    vec2 u;
    casts_shadow = true;
    if (k < u_n_lamps) {
        u = sobol_point(sample_index, seed + uint(k));
    } else {
        vec3 v = point_and_choice(sample_index * uint(n_tree) + uint(k - u_n_lamps), seed + uint(u_n_lamps));
        uint leaf = draw_leaf(u_lamp_tree, s.position, s.normal, v.z, probability);
        if (leaf == NO_LEAF)
            return NO_DRAW;
        lamp = light_node(u_lamp_tree.x + u_lamp_tree.y + leaf).light;
        probability *= float(n_tree);
        u = v.xy;
    }
    casts_shadow = lights[lamp].casts_shadow != 0u;
    LightSample found = sample_lamp(lights[lamp], s.position, u);
    return LightDraw(found.wi, found.distance, found.E_perp / probability, found.pdf * probability);
}

// A ray, and whether any hit will do.
struct Way {
    vec3 o;
    vec3 d;
    float t_max;  // 0: there is nothing to trace
    uint seed;
    bool any_will_do;
};

const Way NO_WAY = Way(vec3(0.0), vec3(0.0), 0.0, 0u, true);

// The ray that finds whether anything hides the light of a draw. It starts on the curved surface that the triangle stands
// for, so that smooth shading ends smoothly [Hanika21], off that surface, and so it points a little elsewhere than wi.
Way shadow_way(LightDraw draw, Surface s, uint seed)
{
    vec3 o = offset_origin(s.position + s.lift, s.normal_geometric, s.normal_geometric), d = draw.wi;
    float t_max = INFINITE;
    if (draw.distance < INFINITE) {
        vec3 to_light = s.position + draw.wi * draw.distance - o;
        float distance = length(to_light);
        d = to_light / max(distance, 1e-20);
        t_max = distance * SHADOW_END - BEFORE * u_bvh_extent;
    }
    return Way(o, d, t_max, seed, true);
}

// Draw k, as seen from a surface that faces the eye or ray which sees it, and the ray that finds its shadow: of lamps, n_tree
// of them from the tree, then of emissive triangles and of the world; `emitter` is what lights/draw has made of it if it is
// one of emissive triangles.
LightDraw draw_light(int k, int n_tree, LightDraw emitter, Surface s, uint sample_index, uint seed, out Way way)
{
    bool casts_shadow = true;
    int n_lamps = n_lamp_draws(n_tree);
    LightDraw draw = emitter;
    if (k < n_lamps)
        draw = draw_lamp(k, n_tree, s, sample_index, seed, casts_shadow);
    else if (k >= n_lamps + u_n_emitter_draws)
        draw = draw_sky(sobol_point(sample_index, hash(seed + 12u)));
    if (dot(s.normal, draw.wi) <= 0.0)
        draw.E_perp = vec3(0.0);
    way = NO_WAY;
    if (draw.E_perp != vec3(0.0) && casts_shadow)
        way = shadow_way(draw, s, hash(seed + sample_index + uint(k)));
    return draw;
}

// Follow a way: whether it met anything.
bool trace(Way way, out Crossing hit)
{
    hit = Crossing(way.t_max, BVH_NONE, 0u, vec2(0.0));
    return way.t_max > 0.0 && trace(way.o, way.d, way.t_max, way.seed, way.any_will_do, hit);
}

// Radiance of one lamp on a ray, drawn with pdf_ray, that surface `from` draws with that probability.
vec3 lamp_on_ray(uint lamp, Surface from, vec3 d, float t_hit, float probability, float pdf_ray)
{
    LightSample found = meet_lamp(lights[lamp], from.position, d);
    if (found.pdf == 0.0 || found.distance > t_hit)
        return vec3(0.0);
    return found.E_perp * found.pdf * balance(pdf_ray, found.pdf * probability);
}

// The next leaf of the lamps' tree whose box the ray meets, from node i on, without a stack: a node's next one is its
// sibling's, or its first child. i becomes the node after it, 0 after the last one.
uint next_leaf(Ray ray, float t_hit, inout uint i)
{
    uint leaf = NO_LEAF;
    while (i != 0u && leaf == NO_LEAF) {
        LightNode node = light_node(u_lamp_tree.x + i);
        float t;
        bool is_met = node.intensity > 0.0 && meets_box(ray, node.low, node.high, t_hit, t);
        if (is_met && i < u_lamp_tree.y) {
            i *= 2u;
            continue;
        }
        if (is_met)
            leaf = i - u_lamp_tree.y;
        i = (i + 1u) >> findLSB(i + 1u);
        i = i == 1u ? 0u : i;
    }
    return leaf;
}

// Radiance of the lamps with a size that a ray from surface `from` along unit d crosses before it has gone t_hit metres,
// weighed against draw_light; pdf_ray [sr^-1] is the density with which the ray was drawn.
vec3 lamps_on_ray(Surface from, vec3 d, float t_hit, float pdf_ray)
{
    vec3 L = vec3(0.0), towards = dot(from.normal, d) < 0.0 ? -from.normal : from.normal;
    Ray ray = make_ray(from.position, d, u_bvh_extent);
    uint node = u_n_tree_draws > 0 ? 1u : 0u;
    for (uint i = 0u; i < uint(u_n_lamps) || node != 0u; i++) {
        uint lamp = i;
        float probability = 1.0;
        if (i >= uint(u_n_lamps)) {
            uint leaf = next_leaf(ray, t_hit, node);
            if (leaf == NO_LEAF)
                break;
            lamp = light_node(u_lamp_tree.x + u_lamp_tree.y + leaf).light;
            probability = leaf_probability(u_lamp_tree, leaf, from.position, towards) * float(u_n_tree_draws);
        }
        L += lamp_on_ray(lamp, from, d, t_hit, probability, pdf_ray);
    }
    return L;
}
