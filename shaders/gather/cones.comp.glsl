// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that arrives at each pixel, as in the thesis: microfacet direct light with a shadow cone a lamp,
//             nine diffuse cones and a specular cone for the indirect light.
// Formula:    E = pi sum w_i L_i, w_i = cos_i / sum cos; specular L times the environment BRDF [Karis13]
// In:         G-buffer, scene, lights, filtered voxels, world
// Out:        u_incident
// Invocation: one pixel

#include "bind/gbuffer.glsl"
#include "bind/incident.glsl"
#include "bind/tiles.glsl"
#include "bind/albedo.glsl"
#include "bind/environment.glsl"
#include "bind/cones.glsl"
#include "lib/brdf.glsl"
#include "lib/light_sampling.glsl"

const int N_LIGHTS = 0;
const bool HAS_TEXTURES = false;
const bool HAS_INDIRECT = true;   // anything that a cone could find
const bool HAS_SPECULAR = true;   // any material that reflects
const int N_RING = 8;             // cones around the one along the normal

layout(local_size_x = 64) in;

layout(std430) readonly buffer Lights { Light lights[]; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_sample;
uniform uint u_seed;
uniform float u_ring_angle;       // between the normal and the cones around it
uniform float u_tan_half_aperture;
uniform float u_tan_half_shadow;
uniform bool u_specular_cone;

// world: the part of it that comes from there.
vec3 cone_light(vec3 p_vx, vec3 normal, vec3 d, float tan_half_angle, out vec3 world)
{
    vec4 met = trace_cone(p_vx, normal, d, tan_half_angle, 1e9);
    world = (1.0 - met.a) * world_radiance(d, tan_half_angle);
    return met.rgb + world;
}

vec3 diffuse_cones(Surface s, out vec3 world)
{
    vec3 p_vx = to_voxels(s.position), world_of_cone;
    mat3 frame = frame_of(s.normal);
    vec3 sum = cone_light(p_vx, s.normal_geometric, s.normal, u_tan_half_aperture, world);
    float weight = 1.0, ring_cos = cos(u_ring_angle), ring_sin = sin(u_ring_angle);
    for (int i = 0; i < N_RING; i++) {
        float phi = 2.0 * PI * float(i) / float(N_RING);
        vec3 d = frame * vec3(ring_sin * cos(phi), ring_sin * sin(phi), ring_cos);
        weight += ring_cos;
        if (dot(d, s.normal_geometric) <= 0.0)
            continue;
        sum += ring_cos * cone_light(p_vx, s.normal_geometric, d, u_tan_half_aperture, world_of_cone);
        world += ring_cos * world_of_cone;
    }
    world *= PI / weight;
    return PI * sum / weight;
}

// The cone ends before it reaches the surface that the lamp may hang under, whose filtered voxels are two wide.
float shadow_cone(Surface s, LightSample light)
{
    float t_max = light.distance * u_voxels_per_metre - u_cone_offset - 2.0;
    return 1.0 - trace_cone(to_voxels(s.position), s.normal_geometric, light.wi, u_tan_half_shadow, t_max).a;
}

void direct_light(Seen seen, vec3 f0, uint seed, inout vec3 E, inout vec3 specular)
{
    Surface s = seen.surface;
    float NoV = dot(s.normal, seen.wo), alpha = max(seen.shading.roughness * seen.shading.roughness, 1e-3);
    for (int i = 0; i < N_LIGHTS; i++) {
        LightSample light = sample_light(lights[i], s.position, sobol_point(u_sample, seed + uint(i)));
        float NoL = dot(s.normal, light.wi);
        if (NoL <= 0.0 || dot(s.normal_geometric, light.wi) <= 0.0 || light.E_perp == vec3(0.0))
            continue;
        vec3 arriving = NoL * light.E_perp * (lights[i].casts_shadow != 0u ? shadow_cone(s, light) : 1.0);
        E += arriving;
        if (HAS_SPECULAR && f0 != vec3(0.0)) {
            vec3 h = normalize(light.wi + seen.wo);
            specular += arriving * microfacet_brdf(f0, alpha, dot(s.normal, h), NoV, NoL, dot(seen.wo, h));
        }
    }
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)) || is_done(pixel))
        return;
    vec3 E_direct = vec3(0.0), E_indirect = vec3(0.0), E_world = vec3(0.0), L_direct = vec3(0.0), L_indirect = vec3(0.0);
    Seen seen = seen_at(pixel, HAS_TEXTURES);
    if (seen.hit) {
        Surface s = seen.surface;
        Material m = materials[s.material];
        vec3 f0 = mix(dielectric_f0(m.ior, m.specular_level) * m.specular_tint, seen.shading.base_color, seen.shading.metallic);
        direct_light(seen, f0, hash(uint(pixel.x) + hash(uint(pixel.y) + u_seed)), E_direct, L_direct);
        if (HAS_INDIRECT) {
            E_indirect = diffuse_cones(s, E_world);
            vec2 ab = environment_brdf(seen.shading.roughness, dot(s.normal, seen.wo));
            vec3 reflectance = f0 * ab.x + (f0 == vec3(0.0) ? 0.0 : ab.y);
            if (HAS_SPECULAR && u_specular_cone && reflectance != vec3(0.0)) {
                float tan_half_angle = clamp(seen.shading.roughness * seen.shading.roughness, 0.01, 1.0);
                vec3 d = reflect(-seen.wo, s.normal), world;
                vec3 L = cone_light(to_voxels(s.position), s.normal_geometric, d, tan_half_angle, world);
                L_direct += reflectance * world;
                L_indirect += reflectance * (L - world);
            }
        }
    }
    arrive(pixel, INCIDENT_DIFFUSE_DIRECT, vec4(E_direct, 0.0));
    arrive(pixel, INCIDENT_DIFFUSE_INDIRECT, vec4(E_indirect, 0.0));
    arrive(pixel, INCIDENT_DIFFUSE_FOUND, vec4(E_world, 0.0));
    arrive(pixel, INCIDENT_GLOSSY_DIRECT, vec4(L_direct, 0.0));
    arrive(pixel, INCIDENT_GLOSSY_INDIRECT, vec4(L_indirect, 0.0));
    arrive(pixel, INCIDENT_TRANSMISSION_DIRECT, vec4(0.0));
    arrive(pixel, INCIDENT_TRANSMISSION_INDIRECT, vec4(0.0));
}
