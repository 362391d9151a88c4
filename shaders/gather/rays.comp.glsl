// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that arrives at each pixel, by rays with exact hits: lamps, emitters and the world drawn, with traced
//             shadows; diffuse light by cosine-distributed rays, reflections by visible GGX normals; all later bounces from
//             the light cache. What draws and rays both find is weighed by the balance heuristic [Veach95].
// Formula:    E = pi / N sum L(w_i), w_i distributed as cos; specular f cos / pdf = F G2 / G1 [Heitz18]
// In:         G-buffer, scene, BVH, lights, light cache, world
// Out:        u_incident
// Invocation: one pixel

#include "bind/gbuffer.glsl"
#include "bind/incident.glsl"
#include "bind/tiles.glsl"
#include "gather/specular.glsl"

const bool HAS_INDIRECT = true;   // anything that a ray could find
const int N_RAYS = 4;             // diffuse rays

uniform uint u_first;
uniform uint u_end;
uniform uint u_seed;

// Irradiance that is drawn.
vec3 drawn_irradiance(Surface s, uint seed)
{
    vec3 E = vec3(0.0);
    for (int k = 0; k < n_draws(); k++)
        E += irradiance_of(draw_light(k, s, number, seed), k, s.normal, float(N_RAYS));
    return E;
}

// found: the part of it that comes from emitters and the world.
vec3 diffuse_light(Surface s, uint seed, out vec3 found)
{
    mat3 frame = frame_of(s.normal);
    vec3 E = vec3(0.0);
    found = vec3(0.0);
    for (int k = 0; k < N_RAYS; k++) {
        vec3 local = cosine_direction(sobol_point(number * uint(N_RAYS) + uint(k), seed)), d = frame * local;
        if (dot(d, s.normal_geometric) <= 0.0)
            continue;
        Hit hit;
        float pdf = float(N_RAYS) * local.z / PI;
        uint ray_seed = hash(seed + uint(k) + 1u);
        if (trace_closest(offset_origin(s.position, s.normal_geometric, d), d, INFINITE, hash(ray_seed + number), hit)) {
            Met met = met_at(hit, d);
            if (met.shading.emission != vec3(0.0))
                found += met.shading.emission * emitter_weight(s, d, hit, pdf);
            E += reflected(met, hit.t, ray_seed);
        } else {
            found += world_radiance(d, 0.0) * world_weight(s, d, pdf);
        }
    }
    found *= PI / float(N_RAYS);
    return E * (PI / float(N_RAYS)) + found;
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)) || is_done(pixel))
        return;
    vec3 E_direct = vec3(0.0), E_indirect = vec3(0.0), E_found = vec3(0.0);
    SpecularLight specular = no_light();
    vec3 eye, d;
    camera_ray(vec2(pixel) + 0.5, eye, d);
    float to_surface = 0.0;
    Seen seen = seen_at(pixel, HAS_TEXTURES);
    if (seen.hit) {
        Surface s = seen.surface;
        uint seed = hash(u_seed);
        number = point_number(pixel);
        to_surface = distance(eye, s.position);
        if (HAS_SPECULAR) {
            Vertex v = vertex_at(s, seen.shading, seen.wo);
            DrawnLight drawn = drawn_light(v, true, float(N_RAYS), seed);
            E_direct = drawn.E;
            specular = specular_light(v, drawn, hash(seed + 3u));
        } else {
            E_direct = drawn_irradiance(s, seed);
        }
        if (HAS_INDIRECT)
            E_indirect = diffuse_light(s, seed, E_found);
    }
    arrive(pixel, INCIDENT_DIFFUSE_DIRECT, vec4(E_direct, 0.0));
    arrive(pixel, INCIDENT_DIFFUSE_INDIRECT, vec4(E_indirect, 0.0));
    arrive(pixel, INCIDENT_DIFFUSE_FOUND, vec4(E_found, 0.0));
    arrive(pixel, INCIDENT_GLOSSY_DIRECT, vec4(specular.glossy_direct, 0.0));
    arrive(pixel, INCIDENT_GLOSSY_INDIRECT, vec4(specular.glossy_indirect, apartness(to_surface, specular.distance)));
    arrive(pixel, INCIDENT_TRANSMISSION_DIRECT, vec4(specular.transmission_direct, 0.0));
    arrive(pixel, INCIDENT_TRANSMISSION_INDIRECT, vec4(specular.transmission_indirect, 0.0));
}
