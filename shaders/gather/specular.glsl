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

// Light that is drawn on one side of the surface and leaves towards wo.
vec3 drawn_light(Vertex v, bool is_through, uint seed)
{
    Surface s = v.surface;
    vec3 L = vec3(0.0);
    if (v.bsdf.alpha <= SMOOTH || (is_through && (v.bsdf.glass == vec3(0.0) || !is_bending(v.bsdf))))
        return L;
    if (is_through)
        s.normal = -s.normal, s.normal_geometric = -s.normal_geometric, s.lift = vec3(0.0);
    for (int k = 0; k < n_draws(); k++) {
        LightDraw draw = draw_light(k, s, number, seed);
        if (draw.E_perp == vec3(0.0))
            continue;
        float pdf;
        vec3 f = evaluate_specular(v.bsdf, v.wo, draw.wi * v.frame, pdf);
        L += f * draw.E_perp * balance(draw.pdf, pdf);
    }
    return L;
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

// What a path finds: `direct` along its first ray, `indirect` after it.
struct Found {
    vec3 direct;
    vec3 indirect;
    bool is_through;  // the first ray
    float distance;
};

// One random path from v on. Each vertex reflects or lets through, and goes on with twice its albedo as probability.
Found follow(Vertex v, uint seed)
{
    Found found = Found(vec3(0.0), vec3(0.0), false, INFINITE);
    vec3 beta = vec3(1.0);
    for (int n = 1; n < N_VERTICES; n++) {
        seed = hash(seed);
        vec2 chances = sobol_point(number, seed + 1u);
        Drawn drawn = sample_specular(v.bsdf, v.wo, sobol_point(number, seed + 2u), chances.x);
        vec3 d = v.frame * drawn.wi;
        beta *= drawn.weight;
        if (n == 1)
            found.is_through = drawn.is_through;
        if (beta == vec3(0.0) || (dot(d, v.surface.normal_geometric) < 0.0) != drawn.is_through)
            break;
        Hit hit;
        Met met;
        vec3 o = offset_origin(v.surface.position, v.surface.normal_geometric, d);
        bool is_hit = trace_closest(o, d, INFINITE, hash(seed + number), hit);
        if (is_hit)
            met = met_at(hit, d);
        vec3 L = beta * found_light(v, d, is_hit, hit, met, drawn.pdf);
        if (n == 1)
            found.direct = L, found.distance = hit.t;
        else
            found.indirect += L;
        if (!is_hit)
            break;
        v = vertex_at(met.surface, met.shading, -d);
        vec3 albedo = v.bsdf.glossy + v.bsdf.transmission;
        bool is_last = n + 1 == N_VERTICES || (v.bsdf.alpha >= ROUGH && v.bsdf.glass == vec3(0.0));
        vec3 ending = v.bsdf.diffuse + (is_last ? v.bsdf.glossy : vec3(0.0));
        if (ending != vec3(0.0))
            found.indirect += beta * ending / PI * arriving(met, number, seed);
        float chance = min(2.0 * max(albedo.r, max(albedo.g, albedo.b)), 1.0);
        if (is_last || chances.y >= chance)
            break;
        beta /= chance;
        found.indirect += beta * (drawn_light(v, false, seed + 3u) + drawn_light(v, true, seed + 4u));
    }
    return found;
}

SpecularLight specular_light(Surface s, Shading shading, vec3 wo, uint seed)
{
    SpecularLight light = no_light();
    Vertex v = vertex_at(s, shading, wo);
    if (v.bsdf.glossy + v.bsdf.transmission == vec3(0.0))
        return light;
    light.glossy_direct = drawn_light(v, false, seed);
    light.transmission_direct = drawn_light(v, true, hash(seed + 1u));
    Found found = follow(v, hash(seed + 2u));
    if (found.is_through) {
        light.transmission_direct += found.direct;
        light.transmission_indirect = found.indirect;
    } else {
        light.glossy_direct += found.direct;
        light.glossy_indirect = found.indirect;
        light.distance = found.distance;
    }
    return light;
}
