// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Principled BSDF, in the order of Cycles' layers: transparency, sheen, coat, emission, metal, glass, a dielectric
// over the ground. Each layer takes what its albedo is from all that lies below it.

#include "nodes/closures_glossy.glsl"
#include "nodes/closures_cloth.glsl"
#include "lib/film.glsl"

const float FILM_CUTOFF = 0.1;  // [nm], as in Cycles

// What is left of light for the layers below, as seen from wo and as light sees it that was spread.
struct Rest {
    vec3 seen;
    vec3 mean;
};

void pass_through(inout Rest rest, vec3 seen, vec3 mean)
{
    rest.seen *= seen;
    rest.mean *= mean;
}

// Light of the layers below goes through a coloured coat at the angle to which it is bent.
vec3 through_coat(vec3 tint, float coat, float ior, float NoV)
{
    float c = sqrt(max(1.0 - (1.0 - NoV * NoV) / (ior * ior), 1e-6));
    return mix(vec3(1.0), min(pow(max(tint, 0.0), vec3(1.0 / c)), 1e6), coat);
}

void add_sheen_layer(inout Closures c, inout Rest rest, Geo g, float sheen, float roughness, vec3 tint, vec3 normal)
{
    if (sheen <= 0.0)
        return;
    vec3 color = sheen * max(tint, 0.0);
    vec3 seen = add_sheen(c, rest.seen * color, g, roughness, normal), mean = color * sheen_albedo(0.5, roughness);
    c.mean += rest.mean * mean;
    pass_through(rest, vec3(below(color * seen.x)), vec3(below(mean)));
}

void add_coat_layer(inout Closures c, inout Rest rest, Geo g, float coat, float roughness, float ior, vec3 tint, vec3 normal)
{
    if (coat <= 0.0)
        return;
    float r = clamp(roughness, 0.0, 1.0), eta = max(ior, 1.0 + 1e-5), NoV = dot(normal, g.wo);
    vec3 f0 = vec3(f0_of_ior(eta)), mean = coat * coat_mean(eta, f0, r, true);
    Bsdf b = no_lobes(vec2(r * r));
    float below_all = add_coat(b, coat * rest.seen, eta, f0, NoV, true);
    add_lobes(c, b, normal);
    c.mean += rest.mean * mean;
    pass_through(rest, clamp(1.0 - coat * (1.0 - below_all), 0.0, 1.0) * through_coat(tint, coat, eta, NoV),
                 below(mean) * through_coat(tint, coat, eta, 0.7));
}

// Facets under a film reflect one colour, that of the angle at which the surface is seen.
void add_filmed(inout Bsdf b, vec3 weight, vec3 f, float NoV, bool has_bounces)
{
    add_metal(b, weight, f, f, vec3(0.0), NoV, has_bounces);
}

// Reflectance under a film [nm] of a dielectric whose own one begins at f0.
vec3 film_tinted(float NoV, float film, float film_ior, float eta, vec3 f0)
{
    vec3 f = film_over_dielectric(NoV, film, film_ior, eta);
    float own = f0_of_ior(eta);
    return own > 1e-5 ? clamp(f * mix(vec3(1.0), f0 / own, clamp((1.0 - f) / (1.0 - own), 0.0, 1.0)), 0.0, 1.0) : f;
}

void add_filmed_glass(inout Bsdf b, vec3 weight, float ior, vec3 f0, vec3 through, float NoV, bool is_back, float film, float film_ior)
{
    float eta = is_back ? 1.0 / ior : ior;
    vec3 f = film_tinted(NoV, film, is_back ? film_ior / ior : film_ior, eta, f0);
    b.glass_eta = eta;
    b.is_level = true;
    b.glass_f0 += weight * f;
    b.glass_f90 += weight;
    b.glass_through += weight * (1.0 - f) * through;
    b.glossy += weight * f;
    b.transmission += weight * (1.0 - f) * through;
}

// film: thickness [nm]; a literal 0 leaves all about films out of the program.
void add_principled(inout Closures c, float weight, Geo g, vec3 base_color, float metallic, float roughness, float ior, float alpha, vec3 normal, float diffuse_roughness, float subsurface, float specular_level, vec3 specular_tint, float anisotropy, float rotation, vec3 tangent, float transmission, float coat, float coat_roughness, float coat_ior, vec3 coat_tint, vec3 coat_normal, float sheen, float sheen_roughness, vec3 sheen_tint, vec3 emission_color, float emission_strength, float film, float film_ior, bool has_bounces)
{
    float opacity = clamp(alpha, 0.0, 1.0), metal = clamp(metallic, 0.0, 1.0), glass = clamp(transmission, 0.0, 1.0);
    float r = clamp(roughness, 0.0, 1.0), index = max(ior, 1e-5);
    vec3 n = seen_normal(g, normal), n_coat = seen_normal(g, coat_normal), color = max(base_color, 0.0), tint = max(specular_tint, 0.0);
    vec3 clamped = min(color, 1.0);
    float NoV = dot(n, g.wo);
    Rest rest = Rest(vec3(weight * opacity), vec3(weight * opacity));
    closure_transparent(c, weight * (1.0 - opacity), vec3(1.0));
    add_sheen_layer(c, rest, g, sheen, sheen_roughness, sheen_tint, coat > 0.0 ? normalize(mix(n, n_coat, min(coat, 1.0))) : n);
    add_coat_layer(c, rest, g, coat, coat_roughness, coat_ior, coat_tint, n_coat);
    c.emission += rest.seen * emission_color * emission_strength;
    vec3 dip = f82_dip(clamped, min(tint, 1.0));
    Bsdf b = grained_lobes(anisotropy > 0.0 ? stretched_alpha(r, anisotropy) : vec2(r * r), n, tangent, rotation);
    bool has_film = film > FILM_CUTOFF;
    float n_film = max(film_ior, 1e-5);
    if (metal > 0.0 && has_film)
        add_filmed(b, metal * rest.seen, film_over_metal(NoV, film, n_film, clamped, f82(clamped, dip, 1.0 / 7.0)), NoV, has_bounces);
    else if (metal > 0.0)
        add_metal(b, metal * rest.seen, clamped, vec3(1.0), dip, NoV, has_bounces);
    c.mean += metal * rest.mean * metal_mean(clamped, dip, vec3(1.0), r, has_bounces);
    pass_through(rest, vec3(1.0 - metal), vec3(1.0 - metal));
    if (glass > 0.0 && has_film)
        add_filmed_glass(b, glass * rest.seen, index, clamp(f0_of_ior(index) * tint, 0.0, 1.0), sqrt(clamped), NoV, g.is_back, film, n_film);
    else if (glass > 0.0)  // its facets have no grain
        add_glass(b, glass * rest.seen, index, clamp(f0_of_ior(index) * tint, 0.0, 1.0), vec3(1.0), sqrt(clamped), NoV, g.is_back, has_bounces);
    pass_through(rest, vec3(1.0 - glass), vec3(1.0 - glass));
    float f0 = 2.0 * max(specular_level, 0.0) * f0_of_ior(index), eta = ior_of_f0(f0);
    if (has_film) {
        vec3 f = film_tinted(NoV, film, n_film, index < 1.0 ? 1.0 / eta : eta, clamp(f0 * tint, 0.0, 1.0));
        add_filmed(b, rest.seen, f, NoV, has_bounces);
        c.mean += rest.mean * f;
        pass_through(rest, vec3(below(f)), vec3(below(f)));
    } else if (f0 > 0.0) {
        vec3 start = clamp(f0 * tint, 0.0, 1.0), mean = coat_mean(eta, start, r, has_bounces);
        float through = add_coat(b, rest.seen, index < 1.0 ? 1.0 / eta : eta, start, NoV, has_bounces);
        c.mean += rest.mean * mean;
        pass_through(rest, vec3(through), vec3(below(mean)));
    }
    add_lobes(c, b, n);
    c.mean += rest.mean * color;
    float spread = clamp(subsurface, 0.0, 1.0);
    add_ground(c, rest.seen * spread * clamped, n, LAMBERT);
    add_ground(c, rest.seen * (1.0 - spread) * color, n, rough_ground(color, diffuse_roughness, NoV));
}

void closure_principled(inout Closures c, float weight, Geo g, vec3 base_color, float metallic, float roughness, float ior, float alpha, vec3 normal, float diffuse_roughness, float subsurface, float specular_level, vec3 specular_tint, float anisotropy, float rotation, vec3 tangent, float transmission, float coat, float coat_roughness, float coat_ior, vec3 coat_tint, vec3 coat_normal, float sheen, float sheen_roughness, vec3 sheen_tint, vec3 emission_color, float emission_strength, bool has_bounces)
{
    add_principled(c, weight, g, base_color, metallic, roughness, ior, alpha, normal, diffuse_roughness, subsurface, specular_level, specular_tint, anisotropy, rotation, tangent, transmission, coat, coat_roughness, coat_ior, coat_tint, coat_normal, sheen, sheen_roughness, sheen_tint, emission_color, emission_strength, 0.0, 1.0, has_bounces);
}

void closure_principled_filmed(inout Closures c, float weight, Geo g, vec3 base_color, float metallic, float roughness, float ior, float alpha, vec3 normal, float diffuse_roughness, float subsurface, float specular_level, vec3 specular_tint, float anisotropy, float rotation, vec3 tangent, float transmission, float coat, float coat_roughness, float coat_ior, vec3 coat_tint, vec3 coat_normal, float sheen, float sheen_roughness, vec3 sheen_tint, vec3 emission_color, float emission_strength, float film, float film_ior, bool has_bounces)
{
    add_principled(c, weight, g, base_color, metallic, roughness, ior, alpha, normal, diffuse_roughness, subsurface, specular_level, specular_tint, anisotropy, rotation, tangent, transmission, coat, coat_roughness, coat_ior, coat_tint, coat_normal, sheen, sheen_roughness, sheen_tint, emission_color, emission_strength, film, film_ior, has_bounces);
}
