// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: light that a surface reflects or lets through without spreading it as its ground does: one path, followed through
//          mirrors and glass. What it meets sends out the diffuse light of the cache, and goes on with its own mirrors.

#include "bind/environment.glsl"
#include "bind/principled.glsl"
#include "gather/met.glsl"

const int N_VERTICES = 24;  // of a path, the pixel's own included
const float ROUGH = 0.25;   // alpha from which a met surface mirrors what arrives from everywhere, not what one ray finds

// Radiance towards the eye. Direct: straight from lights; distance: metres that the ray went, INFINITE to the world.
struct SpecularLight {
    vec3 glossy_direct;
    vec3 glossy_indirect;
    vec3 transmission_direct;
    vec3 transmission_indirect;
    float distance;
};

SpecularLight no_light()
{
    return SpecularLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0);
}

struct Vertex {
    Surface surface;
    Bsdf bsdf;
    mat3 frame;
    vec3 wo;  // in that frame
};

Vertex vertex_at(Surface s, Shading shading, vec3 wo)
{
    mat3 frame = frame_of(s.normal);
    return Vertex(s, principled(materials[s.material], shading, dot(s.normal, wo), s.is_back), frame, wo * frame);
}

// The same surface as lit from behind.
Surface turned_round(Surface s)
{
    s.normal = -s.normal;
    s.normal_geometric = -s.normal_geometric;
    s.lift = vec3(0.0);
    return s;
}

// Light that draws find at a vertex: irradiance on wo's side, weighed against diffuse rays; radiance towards wo.
struct DrawnLight {
    vec3 E;
    vec3 reflected;
    vec3 transmitted;
};

// Share of draw k in the irradiance: n_rays diffuse rays find emitters and the world too, but no lamps.
vec3 irradiance_of(LightDraw draw, int k, vec3 normal, float n_rays)
{
    float NoL = max(dot(normal, draw.wi), 0.0), pdf_rays = k < n_lamp_draws(N_TREE_DRAWS) ? 0.0 : n_rays * NoL / PI;
    return NoL * balance(draw.pdf, pdf_rays) * draw.E_perp;
}

// Light that is drawn on wo's side, and behind glass that spreads it. One loop for both sides: every place that traces rays
// takes compilers seconds. has_ground: whether the irradiance matters; if not, a smooth surface draws nothing.
DrawnLight drawn_light(Vertex v, bool has_ground, float n_rays, uint seed)
{
    DrawnLight light = DrawnLight(vec3(0.0), vec3(0.0), vec3(0.0));
    bool is_smooth = v.bsdf.alpha <= SMOOTH, is_spread_glass = HAS_GLASS && v.bsdf.glass != vec3(0.0) && is_bending(v.bsdf);
    int n_sides = is_smooth ? int(has_ground) : is_spread_glass ? 2 : 1;
    Surface s = v.surface;
    for (int i = 0; i < n_sides * n_draws(); i++) {
        bool is_through = i >= n_draws();
        if (is_through && i == n_draws())
            s = turned_round(s);
        LightDraw draw = draw_light(is_through ? i - n_draws() : i, s, number, is_through ? hash(seed) : seed);
        if (draw.E_perp == vec3(0.0))
            continue;
        if (!is_through)
            light.E += irradiance_of(draw, i, s.normal, n_rays);
        if (is_smooth)
            continue;
        float pdf;
        vec3 f = evaluate_specular(v.bsdf, v.wo, draw.wi * v.frame, pdf);
        vec3 L = f * draw.E_perp * balance(draw.pdf, pdf);
        light.reflected += is_through ? vec3(0.0) : L;
        light.transmitted += is_through ? L : vec3(0.0);
    }
    return light;
}

// Emission that a ray finds: of lamps, of the surface that it hits, or of the world.
vec3 found_light(Vertex v, vec3 d, bool is_hit, Hit hit, Met met, float pdf)
{
    vec3 L = lamps_on_ray(v.surface, d, hit.t, pdf);
    if (!is_hit)
        return L + world_radiance(d, 0.0) * world_weight(v.surface, d, pdf);
    if (met.shading.emission != vec3(0.0))
        L += met.shading.emission * emitter_weight(v.surface, d, hit, pdf);
    return L;
}

// What a ray of a path came to.
struct Leg {
    bool is_hit;
    Met met;
    float t;
    vec3 emitted;  // radiance
};

Leg leg_along(Vertex v, vec3 d, float pdf, uint seed)
{
    Leg leg;
    Hit hit;
    vec3 o = offset_origin(v.surface.position, v.surface.normal_geometric, d);
    leg.is_hit = trace_closest(o, d, INFINITE, hash(seed + number), hit);
    leg.t = hit.t;
    if (leg.is_hit)
        leg.met = met_at(hit, d);
    leg.emitted = found_light(v, d, leg.is_hit, hit, leg.met, pdf);
    return leg;
}

// One random path from vertex v, whose draws are done. Each vertex reflects or lets through, and goes on with twice its albedo
// as probability.
SpecularLight specular_light(Vertex v, DrawnLight drawn_at_eye, uint seed)
{
    SpecularLight light = no_light();
    light.glossy_direct = drawn_at_eye.reflected, light.transmission_direct = drawn_at_eye.transmitted;
    vec3 beta = vec3(1.0), direct = vec3(0.0), indirect = vec3(0.0);
    bool is_first_through = false;
    for (int n = 1; n < N_VERTICES && v.bsdf.glossy + v.bsdf.transmission != vec3(0.0); n++) {
        if (n > 1) {
            DrawnLight found = drawn_light(v, false, 1.0, seed + 3u);
            indirect += beta * (found.reflected + found.transmitted);
        }
        vec2 chances = sobol_point(number, seed + 1u);
        Drawn drawn = sample_specular(v.bsdf, v.wo, sobol_point(number, seed + 2u), chances.x);
        vec3 d = v.frame * drawn.wi;
        beta *= drawn.weight;
        if (beta == vec3(0.0) || (dot(d, v.surface.normal_geometric) < 0.0) != drawn.is_through)
            break;
        Leg leg = leg_along(v, d, drawn.pdf, seed);
        if (n == 1)
            direct = beta * leg.emitted, is_first_through = drawn.is_through, light.distance = leg.t;
        else
            indirect += beta * leg.emitted;
        if (!leg.is_hit)
            break;
        seed = hash(seed);
        v = vertex_at(leg.met.surface, leg.met.shading, -d);
        bool is_last = n + 1 == N_VERTICES || (v.bsdf.alpha >= ROUGH && v.bsdf.glass == vec3(0.0));
        vec3 ending = v.bsdf.diffuse + (is_last ? v.bsdf.glossy : vec3(0.0)), albedo = v.bsdf.glossy + v.bsdf.transmission;
        if (ending != vec3(0.0))
            indirect += beta * ending / PI * arriving(leg.met, number, seed);
        float chance = min(2.0 * max(albedo.r, max(albedo.g, albedo.b)), 1.0);
        if (is_last || chances.y >= chance)
            break;
        beta /= chance;
    }
    if (is_first_through) {
        light.transmission_direct += direct;
        light.transmission_indirect = indirect;
        light.distance = 0.0;
    } else {
        light.glossy_direct += direct;
        light.glossy_indirect = indirect;
    }
    return light;
}
