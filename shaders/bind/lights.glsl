// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: light that is drawn at a point, with traced shadows, and the weights of light that rays find as well. Who draws
// and also follows rays weighs both by the balance heuristic.

#include "bind/trace.glsl"
#include "lib/light_sampling.glsl"

const int N_LIGHTS = 0;
const float SHADOW_END = 0.9999;  // of the way: the lamp may touch a surface

layout(std430) readonly buffer Lights { Light lights[]; };

// One draw. The sum over all draws is the light that arrives.
struct LightDraw {
    vec3 wi;         // unit, towards the light
    float distance;  // metres
    vec3 E_perp;     // irradiance [W m^-2] of a surface that faces it, shadows included
    float pdf;       // [sr^-1] with which this draw finds wi; 0: nothing else finds it
};

// How many draws a surface needs.
int n_draws()
{
    return N_LIGHTS;
}

// Draw k of n_draws() as seen from a surface that faces the eye or ray which sees it. The ray starts on the curved surface
// that the triangle stands for, so that smooth shading ends smoothly [Hanika21].
LightDraw draw_light(int k, Surface s, uint sample_index, uint seed)
{
    LightSample light = sample_light(lights[k], s.position, sobol_point(sample_index, seed + uint(k)));
    vec3 o = offset_origin(s.position + s.lift, s.normal_geometric, s.normal_geometric);
    if (light.E_perp == vec3(0.0) || dot(s.normal, light.wi) <= 0.0
        || (lights[k].casts_shadow != 0u && trace_any(o, light.wi, light.distance * SHADOW_END, hash(seed + sample_index))))
        light.E_perp = vec3(0.0);
    return LightDraw(light.wi, light.distance, light.E_perp, 0.0);
}

// Share of what was found with density pdf_own, while something else finds it with pdf_other; all of it if pdf_own is 0.
float balance(float pdf_own, float pdf_other)
{
    return pdf_own > 0.0 ? 1.0 / (1.0 + pdf_other / pdf_own) : 1.0;
}

// Radiance of the lamps with a size that a ray from surface `from` along unit d crosses before it has gone t_hit metres,
// weighed against draw_light; pdf_ray [sr^-1] is the density with which the ray was drawn.
vec3 lamps_on_ray(Surface from, vec3 d, float t_hit, float pdf_ray)
{
    return vec3(0.0);
}

// Weight of the emission of a triangle that such a ray hits.
float emitter_weight(Surface from, vec3 d, Hit hit, float pdf_ray)
{
    return 1.0;
}

// Weight of the world that such a ray sees.
float world_weight(Surface from, vec3 d, float pdf_ray)
{
    return 1.0;
}

// Irradiance [W m^-2] from all lamps.
vec3 lamps_irradiance(Surface s, uint sample_index, uint seed)
{
    vec3 E = vec3(0.0);
    for (int k = 0; k < N_LIGHTS; k++) {
        LightDraw draw = draw_light(k, s, sample_index, seed);
        E += max(dot(s.normal, draw.wi), 0.0) * draw.E_perp;
    }
    return E;
}
