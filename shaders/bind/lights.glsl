// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: light that is drawn at a point, with traced shadows, and the weights of light that rays find as well. Who draws
// and also follows rays weighs both by the balance heuristic [Veach95], and no light is counted twice.

#include "bind/emitters.glsl"
#include "bind/sky.glsl"
#include "lib/light_sampling.glsl"

const int N_LIGHTS = 0;         // lamps that are drawn each by itself: they come first
const bool HAS_TREE = false;    // of the others
const int N_TREE_DRAWS = 1;
const float SHADOW_END = 0.9999;  // of the way: the light may touch a surface
const float BEFORE = 2e-6;        // of the scene: a lamp that is a surface must not hide itself, as wrong as its place may be

layout(std430) readonly buffer Lights { Light lights[]; };

uniform uvec2 u_lamp_tree;  // its first node, its number of leaves

// Share of what was found with density pdf_own, while something else finds it with pdf_other; all of it if pdf_own is 0.
float balance(float pdf_own, float pdf_other)
{
    return pdf_own > 0.0 ? 1.0 / (1.0 + pdf_other / pdf_own) : 1.0;
}

// How many of all draws are those of lamps, n_tree of them from the tree: they come first.
int n_lamp_draws(int n_tree)
{
    return N_LIGHTS + (HAS_TREE ? n_tree : 0);
}

// How many draws a surface needs.
int n_draws()
{
    return n_lamp_draws(N_TREE_DRAWS) + (HAS_EMITTERS ? N_EMITTER_DRAWS : 0) + (HAS_WORLD_DRAWS ? 1 : 0);
}

// Where on a light, and in z which one.
vec3 point_and_choice(uint i, uint seed)
{
    return vec3(sobol_point(i, seed), sobol_point(i, hash(seed)).x);
}

// Draw k of lamps, without its shadow; casts_shadow: whether it has one.
LightDraw draw_lamp(int k, int n_tree, Surface s, uint sample_index, uint seed, out bool casts_shadow)
{
    uint lamp = uint(k);
    float probability = 1.0;
    vec2 u;
    if (!HAS_TREE || k < N_LIGHTS) {
        u = sobol_point(sample_index, seed + uint(k));
    } else {
        vec3 v = point_and_choice(sample_index * uint(n_tree) + uint(k - N_LIGHTS), seed + uint(N_LIGHTS));
        uint leaf = draw_leaf(u_lamp_tree, s.position, s.normal, v.z, probability);
        if (leaf == NO_LEAF)
            return NO_DRAW;
        lamp = light_node(u_lamp_tree.x + u_lamp_tree.y + leaf).light;
        probability *= float(n_tree);
        u = v.xy;
    }
    casts_shadow = lights[lamp].casts_shadow != 0u;
    LightSample found = sample_light(lights[lamp], s.position, u);
    return LightDraw(found.wi, found.distance, found.E_perp / probability, found.pdf * probability);
}

// Draw k after those of lamps, without its shadow.
LightDraw draw_other(int k, Surface s, uint sample_index, uint seed)
{
    if (HAS_EMITTERS && k < N_EMITTER_DRAWS)
        return draw_emitter(s, point_and_choice(sample_index * uint(N_EMITTER_DRAWS) + uint(k), hash(seed + 11u)));
    return HAS_WORLD_DRAWS ? draw_sky(sobol_point(sample_index, hash(seed + 12u))) : NO_DRAW;
}

// Whether anything hides the light of a draw. The ray starts on the curved surface that the triangle stands for, so that
// smooth shading ends smoothly [Hanika21], off that surface, and so it points a little elsewhere than wi.
bool is_hidden(LightDraw draw, Surface s, uint seed)
{
    vec3 o = offset_origin(s.position + s.lift, s.normal_geometric, s.normal_geometric), d = draw.wi;
    float t_max = INFINITE;
    if (draw.distance < INFINITE) {
        vec3 to_light = s.position + draw.wi * draw.distance - o;
        float distance = length(to_light);
        d = to_light / max(distance, 1e-20);
        t_max = distance * SHADOW_END - BEFORE * u_bvh_extent;
    }
    return trace_any(o, d, t_max, seed);
}

// The draw with its shadow, as seen from a surface that faces the eye or ray which sees it.
LightDraw shadowed(LightDraw draw, Surface s, bool casts_shadow, uint seed)
{
    if (draw.E_perp == vec3(0.0) || dot(s.normal, draw.wi) <= 0.0 || (casts_shadow && is_hidden(draw, s, seed)))
        draw.E_perp = vec3(0.0);
    return draw;
}

// Draw k of n_draws().
LightDraw draw_light(int k, Surface s, uint sample_index, uint seed)
{
    bool casts_shadow = true;
    int n_lamps = n_lamp_draws(N_TREE_DRAWS);
    LightDraw draw;
    if (k < n_lamps)
        draw = draw_lamp(k, N_TREE_DRAWS, s, sample_index, seed, casts_shadow);
    else
        draw = draw_other(k - n_lamps, s, sample_index, seed);
    return shadowed(draw, s, casts_shadow, hash(seed + sample_index + uint(k)));
}

// Irradiance [W m^-2] from all lamps, from many by n_tree draws.
vec3 lamps_irradiance(Surface s, int n_tree, uint sample_index, uint seed)
{
    vec3 E = vec3(0.0);
    for (int k = 0; k < n_lamp_draws(n_tree); k++) {
        bool casts_shadow = true;
        LightDraw draw = draw_lamp(k, n_tree, s, sample_index, seed, casts_shadow);
        draw = shadowed(draw, s, casts_shadow, hash(seed + sample_index + uint(k)));
        E += max(dot(s.normal, draw.wi), 0.0) * draw.E_perp;
    }
    return E;
}

// Radiance of one lamp on a ray, drawn with pdf_ray, that surface `from` draws with that probability.
vec3 lamp_on_ray(uint lamp, Surface from, vec3 d, float t_hit, float probability, float pdf_ray)
{
    LightSample found = meet_light(lights[lamp], from.position, d);
    if (found.pdf == 0.0 || found.distance > t_hit)
        return vec3(0.0);
    return found.E_perp * found.pdf * balance(pdf_ray, found.pdf * probability);
}

// The normal on the side of d.
vec3 normal_towards(Surface from, vec3 d)
{
    return dot(from.normal, d) < 0.0 ? -from.normal : from.normal;
}

// The tree's boxes that the ray meets, without a stack: a node's next one is its sibling's, or its first child.
vec3 tree_lamps_on_ray(Surface from, vec3 d, float t_hit, float pdf_ray)
{
    vec3 L = vec3(0.0);
    Ray ray = make_ray(from.position, d, u_bvh_extent);
    uint i = 1u;
    while (i != 0u) {
        LightNode node = light_node(u_lamp_tree.x + i);
        float t;
        bool is_met = node.intensity > 0.0 && meets_box(ray, node.low, node.high, t_hit, t);
        if (is_met && i < u_lamp_tree.y) {
            i *= 2u;
            continue;
        }
        if (is_met) {
            float p = leaf_probability(u_lamp_tree, i - u_lamp_tree.y, from.position, normal_towards(from, d));
            L += lamp_on_ray(node.light, from, d, t_hit, p * float(N_TREE_DRAWS), pdf_ray);
        }
        i = (i + 1u) >> findLSB(i + 1u);
        i = i == 1u ? 0u : i;
    }
    return L;
}

// Radiance of the lamps with a size that a ray from surface `from` along unit d crosses before it has gone t_hit metres,
// weighed against draw_light; pdf_ray [sr^-1] is the density with which the ray was drawn.
vec3 lamps_on_ray(Surface from, vec3 d, float t_hit, float pdf_ray)
{
    vec3 L = vec3(0.0);
    for (int i = 0; i < N_LIGHTS; i++)
        L += lamp_on_ray(uint(i), from, d, t_hit, 1.0, pdf_ray);
    return HAS_TREE ? L + tree_lamps_on_ray(from, d, t_hit, pdf_ray) : L;
}

// Weight of the emission of a triangle that such a ray hits.
float emitter_weight(Surface from, vec3 d, Hit hit, float pdf_ray)
{
    if (!HAS_EMITTERS)
        return 1.0;
    return balance(pdf_ray, emitter_density(from.position, normal_towards(from, d), d, hit.instance, hit.triangle));
}

// Weight of the world that such a ray sees.
float world_weight(Surface from, vec3 d, float pdf_ray)
{
    return HAS_WORLD_DRAWS ? balance(pdf_ray, world_density(d)) : 1.0;
}
