// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: how much light is drawn for a point, and in which order: lamps, those of their tree, emissive triangles, the
// world's image.

#include "lib/light_draw.glsl"
#include "lib/math.glsl"

uniform int u_n_lamps;          // that are drawn each by itself
uniform int u_n_tree_draws;     // of the others, at what the eye sees; 0 if there are none
uniform int u_n_emitter_draws;  // 0 if there are none
uniform int u_n_sky_draws;      // likewise

// How many of all draws are those of lamps, n_tree of them from the tree: they come first.
int n_lamp_draws(int n_tree)
{
    return u_n_lamps + min(n_tree, u_n_tree_draws);
}

// How many draws a point needs.
int n_draws()
{
    return n_lamp_draws(u_n_tree_draws) + u_n_emitter_draws + u_n_sky_draws;
}

// Where on a light, and in z which one.
vec3 point_and_choice(uint i, uint seed)
{
    return vec3(sobol_point(i, seed), sobol_point(i, hash(seed)).x);
}
