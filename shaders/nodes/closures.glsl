// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a tree gives: the closures of a point. A point has room for one ground and one set of lobes, those that share
// their microfacets. What is alike is summed; of what is not, one is kept by chance and divided by its probability, so that the
// mean is right. Light that passes or is sent out is summed. `mean` needs no chance: what light that was spread sees.

#include "bind/geo.glsl"
#include "bind/layers.glsl"
#include "lib/shapes.glsl"

struct Closures {
    vec3 ground;          // albedo of the diffuse reflection that was kept
    vec3 ground_normal;
    Shape shape;
    float ground_mass;    // albedo of all, mean of the channels
    Bsdf lobes;           // the kept set
    vec3 lobes_normal;
    float lobes_mass;
    vec3 behind;          // albedo for light from behind
    vec3 behind_normal;
    vec3 emission;        // radiance
    vec3 transparency;    // of light that passes as it came
    float holdout;
    vec3 mean;            // share of light from everywhere that comes back to everywhere
    bool wants_mean;      // no coins are tossed
    float chance;         // of what is left of the random number
};

Closures no_closures(Geo g, float chance, bool wants_mean)
{
    vec3 none = vec3(0.0);
    return Closures(none, g.normal, LAMBERT, 0.0, no_lobes(vec2(1.0)), g.normal, 0.0, none, g.normal, none, none, 0.0, none,
                    wants_mean, chance);
}

// True with that probability; what is left of the random number is as random as before.
bool toss(inout Closures c, float probability)
{
    bool is_so = c.chance < probability;
    c.chance = is_so ? c.chance / probability : (c.chance - probability) / max(1.0 - probability, 1e-6);
    return is_so;
}

// The normal of a closure as it is seen: facing the eye.
vec3 seen_normal(Geo g, vec3 normal)
{
    float l2 = dot(normal, normal);
    return facing(l2 > 1e-20 ? normal * inversesqrt(l2) : g.normal, g.wo);
}

bool is_alike(Shape a, Shape b)
{
    return a.kind == b.kind && a.at == b.at && a.color == b.color;
}

void add_ground(inout Closures c, vec3 albedo, vec3 normal, Shape shape)
{
    float mass = mean_of(albedo), sum = c.ground_mass + mass;
    if (mass <= 0.0)
        return;
    c.ground_mass = sum;
    if (sum == mass || (normal == c.ground_normal && is_alike(shape, c.shape))) {
        c.ground += albedo;
    } else if (toss(c, mass / sum)) {
        c.ground = albedo * (sum / mass);
    } else {
        c.ground *= sum / (sum - mass);
        return;
    }
    c.ground_normal = normal;
    c.shape = shape;
}

// Whether two sets share their microfacets and all that Fresnel's equations ask for.
bool is_alike(Bsdf a, Bsdf b)
{
    return a.alpha == b.alpha && a.turn == b.turn && (a.coat_eta == b.coat_eta || !has_coat(a) || !has_coat(b))
        && ((a.glass_eta == b.glass_eta && a.is_level == b.is_level) || !has_glass(a) || !has_glass(b));
}

// a times k, with b times l; of alike ones
Bsdf sum_of(Bsdf a, float k, Bsdf b, float l)
{
    Bsdf s = a;
    s.metal_f0 = k * a.metal_f0 + l * b.metal_f0;
    s.metal_f90 = k * a.metal_f90 + l * b.metal_f90;
    s.metal_dip = k * a.metal_dip + l * b.metal_dip;
    s.coat_f0 = k * a.coat_f0 + l * b.coat_f0;
    s.coat_f90 = k * a.coat_f90 + l * b.coat_f90;
    s.coat_eta = has_coat(a) ? a.coat_eta : b.coat_eta;
    s.glass_f0 = k * a.glass_f0 + l * b.glass_f0;
    s.glass_f90 = k * a.glass_f90 + l * b.glass_f90;
    s.glass_through = k * a.glass_through + l * b.glass_through;
    s.glass_eta = has_glass(a) ? a.glass_eta : b.glass_eta;
    s.is_level = has_glass(a) ? a.is_level : b.is_level;
    s.glossy = k * a.glossy + l * b.glossy;
    s.transmission = k * a.transmission + l * b.transmission;
    return s;
}

void add_lobes(inout Closures c, Bsdf b, vec3 normal)
{
    float mass = mean_of(b.glossy + b.transmission), sum = c.lobes_mass + mass;
    if (mass <= 0.0)
        return;
    bool is_first = c.lobes_mass == 0.0, is_same = !is_first && normal == c.lobes_normal && is_alike(b, c.lobes);
    bool is_kept = is_first || is_same || toss(c, mass / sum);
    float own = is_first || is_same ? 1.0 : is_kept ? sum / mass : 0.0, other = is_same ? 1.0 : is_kept ? 0.0 : sum / (sum - mass);
    if (is_kept && !is_same) {
        c.lobes = b;
        c.lobes_normal = normal;
        c.lobes = sum_of(b, own, b, 0.0);
    } else {
        c.lobes = sum_of(c.lobes, other, b, own);
    }
    c.lobes_mass = sum;
}

void add_behind(inout Closures c, vec3 albedo, vec3 normal)
{
    c.behind += albedo;
    if (mean_of(albedo) > 0.0)
        c.behind_normal = normal;
}

// Nothing, where anything has overflowed or is no number: Cycles drops such samples.
void keep_finite(Geo g, inout Closures c)
{
    Bsdf b = c.lobes;
    vec3 sum = abs(c.ground) + abs(c.behind) + abs(c.emission) + abs(c.transparency) + abs(c.mean) + abs(c.shape.color)
             + abs(b.metal_f0) + abs(b.metal_f90) + abs(b.metal_dip) + abs(b.coat_f0) + abs(b.coat_f90) + abs(b.glass_f0)
             + abs(b.glass_f90) + abs(b.glass_through) + abs(b.glossy) + abs(b.transmission)
             + abs(c.ground_normal) + abs(c.lobes_normal) + abs(c.behind_normal);
    vec2 rest = abs(b.alpha) + abs(c.shape.at);
    float all_of_it = dot(sum, vec3(1.0)) + rest.x + rest.y + abs(b.turn) + abs(b.coat_eta) + abs(b.glass_eta) + c.ground_mass
                    + c.lobes_mass + abs(c.holdout) + c.chance;
    if ((floatBitsToUint(all_of_it) & 0x7f800000u) == 0x7f800000u)
        c = no_closures(g, 0.5, c.wants_mean);
}

void closure_emission(inout Closures c, float weight, vec3 color, float strength)
{
    c.emission += weight * strength * color;
}

void closure_transparent(inout Closures c, float weight, vec3 color)
{
    c.transparency += weight * max(color, 0.0);
}

void closure_holdout(inout Closures c, float weight)
{
    c.holdout += weight;
}

void closure_diffuse(inout Closures c, float weight, Geo g, vec3 color, float roughness, vec3 normal)
{
    vec3 albedo = weight * max(color, 0.0), n = seen_normal(g, normal);
    c.mean += albedo;
    add_ground(c, albedo, n, rough_ground(color, roughness, dot(n, g.wo)));
}

void closure_translucent(inout Closures c, float weight, Geo g, vec3 color, vec3 normal)
{
    vec3 albedo = weight * max(color, 0.0);
    c.mean += albedo;
    add_behind(c, albedo, seen_normal(g, normal));
}

// A ground of the colour that light has which comes back from below the surface.
void closure_subsurface(inout Closures c, float weight, Geo g, vec3 color, vec3 normal)
{
    closure_diffuse(c, weight, g, clamp(color, 0.0, 1.0), 0.0, normal);
}
