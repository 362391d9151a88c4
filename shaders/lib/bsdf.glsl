// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a surface does with light: a metal, glass and a coat over a diffuse ground, which share their microfacets.
// Directions point away from the surface, unit vectors in its frame, whose z is the normal on wo's side and whose x is the
// tangent. Reflectances hold the part of their layer and its multiple scattering, so that layers of one kind add up.

#include "lib/ggx.glsl"

const float SMOOTH = 1.4e-5;  // alpha up to which a surface is a perfect mirror or pane, as in Cycles

struct Bsdf {
    vec3 diffuse;      // albedo of the ground, with what the layers above let through
    vec2 alpha;        // along the tangent, and across
    float turn;        // from the frame's first axis to the tangent [rad]
    vec3 metal_f0;     // F = f0 + (f90 - f0) m^5 - dip c m^6, m = 1 - c, c the cosine at a facet
    vec3 metal_f90;
    vec3 metal_dip;
    vec3 coat_f0;      // F = f0 + (f90 - f0) s, s the place of the true Fresnel curve between its own ends
    vec3 coat_f90;
    float coat_eta;
    vec3 glass_f0;     // likewise; what passes is glass_through (1 - s)
    vec3 glass_f90;
    vec3 glass_through;
    float glass_eta;   // index of refraction beyond the surface over the one on wo's side
    bool is_level;     // whether glass has s = 0 at all angles short of total reflection
    vec3 glossy;       // albedos of all that is not diffuse, by where light goes
    vec3 transmission;
};

Bsdf no_lobes(vec2 alpha)
{
    vec3 none = vec3(0.0);
    return Bsdf(none, alpha, 0.0, none, none, none, none, none, 1.0, none, none, none, 1.0, false, none, none);
}

bool has_coat(Bsdf b)
{
    return b.coat_f90 != vec3(0.0);
}

bool has_glass(Bsdf b)
{
    return b.glass_f90 + b.glass_through != vec3(0.0);
}

bool is_smooth(Bsdf b)
{
    return b.alpha.x * b.alpha.y <= SMOOTH * SMOOTH;
}

// What one microfacet reflects and lets through, c the cosine at it.
void facet_shares(Bsdf b, float c, out vec3 reflected, out vec3 transmitted)
{
    reflected = transmitted = vec3(0.0);
    if (b.metal_f90 + b.metal_f0 != vec3(0.0)) {
        float m = clamp(1.0 - c, 0.0, 1.0), m5 = m * m * m * m * m;
        reflected += max(mix(b.metal_f0, b.metal_f90, m5) - b.metal_dip * (c * m5 * m), 0.0);
    }
    if (has_coat(b))
        reflected += mix(b.coat_f0, b.coat_f90, share_of_f(f_dielectric(c, b.coat_eta), b.coat_eta));
    if (has_glass(b)) {
        float f = f_dielectric(c, b.glass_eta), s = share_of_f(f, b.glass_eta);
        s = b.is_level && f < 1.0 ? 0.0 : s;
        reflected += mix(b.glass_f0, b.glass_f90, s);
        transmitted = b.glass_through * (1.0 - s);
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
    if (is_smooth(b) || wi.z == 0.0 || (is_through && !(is_bending(b))))
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
    bool is_mirror = is_smooth(b);
    vec3 h = is_mirror ? vec3(0.0, 0.0, 1.0) : visible_normal(wo, b.alpha, u), reflected, transmitted;
    facet_shares(b, dot(wo, h), reflected, transmitted);
    float chance = reflect_chance(reflected, transmitted);
    bool is_through = v >= chance;
    float p = is_through ? 1.0 - chance : chance;
    Drawn drawn = Drawn(reflect(-wo, h), INFINITE, (is_through ? transmitted : reflected) / p, is_through);
    if (is_through)
        drawn.wi = is_bending(b) ? refract(-wo, h, 1.0 / b.glass_eta) : -wo;
    if (dot(wo, h) <= 0.0 || (is_through ? drawn.wi.z >= 0.0 : drawn.wi.z <= 0.0))
        drawn.weight = vec3(0.0);
    if (is_mirror || (is_through && !is_bending(b)))
        return drawn;
    float lambda_o = ggx_lambda(wo, b.alpha), lambda_i = ggx_lambda(drawn.wi, b.alpha);
    drawn.weight *= (1.0 + lambda_o) / (1.0 + lambda_o + lambda_i);
    drawn.pdf = p * density_of(b, wo, drawn.wi, h) / (1.0 + lambda_o);
    return drawn;
}
