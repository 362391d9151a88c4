// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the table of bind/albedo.glsl, which says how much light microfacets lose to each other and to the ground.
// Formula:    E(wo) = int f cos dwi = mean of F G2 / G1 over the normals that wo sees [Heitz18], for light 1 from everywhere
// In:         nothing
// Out:        u_table, layers of ALBEDO_N by ALBEDO_N
// Invocation: one texel of one layer

#include "bind/albedo.glsl"

const int N_SAMPLES = 377;             // a Fibonacci number, whose lattice is the most even
const float GOLDEN = 0.6180339887499;

layout(local_size_x = 64) in;

layout(rgba32f) uniform writeonly image2DArray u_table;

uniform uint u_first;
uniform uint u_end;

// The part of what a facet sends along wi that no other facet stops; none where wi comes out on the wrong side.
float passing(vec3 wo, vec3 wi, float side, float alpha)
{
    float lambda_o = ggx_lambda(wo, alpha);
    return wi.z * side > 0.0 ? (1.0 + lambda_o) / (1.0 + lambda_o + ggx_lambda(wi, alpha)) : 0.0;
}

float glass(vec3 wo, vec3 h, float eta, float alpha)
{
    float f = f_dielectric(dot(wo, h), eta), through = 0.0;
    if (f < 1.0)
        through = passing(wo, refract(-wo, h, 1.0 / max(eta, 1e-3)), -1.0, alpha);
    return f * passing(wo, reflect(-wo, h), 1.0, alpha) + (1.0 - f) * through;
}

// One sample of a dielectric: E, E F', glass from outside, glass from inside.
vec4 dielectric(vec3 wo, vec3 h, float ior, float alpha)
{
    float e = passing(wo, reflect(-wo, h), 1.0, alpha);
    float f = f_from(vec3(0.0), f_dielectric(dot(wo, h), ior), ior).x;
    return vec4(e, e * f, glass(wo, h, ior, alpha), glass(wo, h, 1.0 / ior, alpha));
}

// One sample of a metal: E, E F for f0 = 0, nothing yet, the dip of f82.
vec4 metal(vec3 wo, vec3 h, float alpha)
{
    float m = 1.0 - dot(wo, h), m5 = m * m * m * m * m;
    return passing(wo, reflect(-wo, h), 1.0, alpha) * vec4(1.0, m5, 0.0, (1.0 - m) * m5 * m);
}

vec3 direction_of(float c)
{
    return vec3(sqrt(max(1.0 - c * c, 0.0)), 0.0, c);
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    if (index >= u_end)
        return;
    ivec3 at = ivec3(int(index) % ALBEDO_N, int(index) / ALBEDO_N % ALBEDO_N, int(index) / (ALBEDO_N * ALBEDO_N));
    vec2 place = vec2(at.xy) / float(ALBEDO_N - 1);
    float alpha = max(place.x * place.x, 1e-4), c = max(place.y * place.y, 1e-4);
    float ior = albedo_ior(at.z == ALBEDO_MEANS ? place.y * float(ALBEDO_IORS - 1) : float(at.z));
    vec4 sum = vec4(0.0);
    for (int k = 0; k < N_SAMPLES; k++) {
        vec2 u = vec2((float(k) + 0.5) / float(N_SAMPLES), fract(float(k) * GOLDEN));
        vec3 any = direction_of(sqrt(sobol_point(uint(k), 0u).x));  // distributed as its cosine
        vec3 wo = at.z == ALBEDO_MEANS ? any : direction_of(c);
        vec3 h = visible_normal(wo, alpha, u);
        sum += at.z == ALBEDO_METALS ? metal(wo, h, alpha) : dielectric(wo, h, ior, alpha);
        if (at.z == ALBEDO_METALS)
            sum.z += metal(any, visible_normal(any, alpha, u), alpha).x;
    }
    sum /= float(N_SAMPLES);
    imageStore(u_table, at, at.z == ALBEDO_MEANS ? sum.zwxy : sum);
}
