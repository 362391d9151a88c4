// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a surface does with light: a metal, glass and a coat over a diffuse ground, which share their microfacets.
// Directions point away from the surface, unit vectors in its frame, whose z is the normal on wo's side.

#include "lib/ggx.glsl"

const float SMOOTH = 1.4e-5;  // alpha up to which a surface is a perfect mirror or pane, as in Cycles

// metal, coat, glass: the part of each layer with its multiple scattering; zero where there is none.
struct Bsdf {
    vec3 diffuse;    // albedo of the ground, with what the layers above let through
    float alpha;
    vec3 metal;
    vec3 metal_f0;
    vec3 metal_dip;
    vec3 coat;
    vec3 coat_f0;
    float coat_eta;
    vec3 glass;
    vec3 glass_f0;
    vec3 glass_tint;
    float glass_eta;  // index of refraction beyond the surface over the one on wo's side
    vec3 glossy;      // albedos of all that is not diffuse, by where light goes
    vec3 transmission;
};

// What one microfacet reflects and lets through, c the cosine at it.
void facet_shares(Bsdf b, float c, out vec3 reflected, out vec3 transmitted)
{
    reflected = transmitted = vec3(0.0);
    if (b.metal != vec3(0.0))
        reflected += b.metal * f82(b.metal_f0, b.metal_dip, c);
    if (b.coat != vec3(0.0))
        reflected += b.coat * f_from(b.coat_f0, f_dielectric(c, b.coat_eta), b.coat_eta);
    if (b.glass != vec3(0.0)) {
        vec3 f = f_from(b.glass_f0, f_dielectric(c, b.glass_eta), b.glass_eta);
        reflected += b.glass * f;
        transmitted = b.glass * b.glass_tint * (1.0 - f);
    }
}

float mean_of(vec3 c)
{
    return (c.r + c.g + c.b) / 3.0;
}

// The probability with which a microfacet reflects rather than lets through.
float reflect_chance(vec3 reflected, vec3 transmitted)
{
    float r = mean_of(reflected), t = mean_of(transmitted);
    return t == 0.0 ? 1.0 : r / (r + t);
}

// Whether the glass bends light at all: otherwise what passes it goes on as it came.
bool is_bending(Bsdf b)
{
    return abs(b.glass_eta - 1.0) > 1e-4;
}

// Density of wi [sr^-1] that comes of the microfacet h, as if every facet were visible and sent all light to wi [Walter07].
float density_of(Bsdf b, vec3 wo, vec3 wi, vec3 h)
{
    float VoH = dot(wo, h), LoH = dot(wi, h), to_wi = 0.25 / VoH;
    if (LoH < 0.0) {
        float k = VoH + b.glass_eta * LoH;
        to_wi = b.glass_eta * b.glass_eta * -LoH / max(k * k, 1e-30);
    }
    return ggx_normals(h, b.alpha) * VoH * to_wi / wo.z;
}

// f |cos| of all but the ground [sr^-1], wi on either side; and the density [sr^-1] with which sample_specular draws wi.
vec3 evaluate_specular(Bsdf b, vec3 wo, vec3 wi, out float pdf)
{
    pdf = 0.0;
    bool is_through = wi.z < 0.0;
    if (b.alpha <= SMOOTH || wi.z == 0.0 || (is_through && !(is_bending(b))))
        return vec3(0.0);
    vec3 h = is_through ? wo + b.glass_eta * wi : wo + wi;
    h = normalize(h.z < 0.0 ? -h : h);
    if (dot(wo, h) <= 0.0 || (dot(wi, h) < 0.0) != is_through)
        return vec3(0.0);
    vec3 reflected, transmitted;
    facet_shares(b, dot(wo, h), reflected, transmitted);
    float chance = reflect_chance(reflected, transmitted), density = density_of(b, wo, wi, h);
    float lambda_o = ggx_lambda(wo, b.alpha), lambda_i = ggx_lambda(wi, b.alpha);
    pdf = density / (1.0 + lambda_o) * (is_through ? 1.0 - chance : chance);
    return (is_through ? transmitted : reflected) * (density / (1.0 + lambda_o + lambda_i));
}

struct Drawn {
    vec3 wi;
    float pdf;        // [sr^-1], INFINITE where there is but one direction
    vec3 weight;      // f |cos| / pdf; zero where wi comes out on the wrong side
    bool is_through;
};

// A direction of all but the ground: a visible normal by u, then reflection or refraction at it by v.
Drawn sample_specular(Bsdf b, vec3 wo, vec2 u, float v)
{
    bool is_smooth = b.alpha <= SMOOTH;
    vec3 h = is_smooth ? vec3(0.0, 0.0, 1.0) : visible_normal(wo, b.alpha, u), reflected, transmitted;
    facet_shares(b, dot(wo, h), reflected, transmitted);
    float chance = reflect_chance(reflected, transmitted);
    bool is_through = v >= chance;
    float p = is_through ? 1.0 - chance : chance;
    Drawn drawn = Drawn(reflect(-wo, h), INFINITE, (is_through ? transmitted : reflected) / p, is_through);
    if (is_through)
        drawn.wi = is_bending(b) ? refract(-wo, h, 1.0 / b.glass_eta) : -wo;
    if (dot(wo, h) <= 0.0 || (is_through ? drawn.wi.z >= 0.0 : drawn.wi.z <= 0.0))
        drawn.weight = vec3(0.0);
    if (is_smooth || (is_through && !is_bending(b)))
        return drawn;
    float lambda_o = ggx_lambda(wo, b.alpha), lambda_i = ggx_lambda(drawn.wi, b.alpha);
    drawn.weight *= (1.0 + lambda_o) / (1.0 + lambda_o + lambda_i);
    drawn.pdf = p * density_of(b, wo, drawn.wi, h) / (1.0 + lambda_o);
    return drawn;
}
