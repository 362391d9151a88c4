// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that arrives at each pixel, as in the thesis: microfacet direct light with a shadow cone a lamp,
//             nine diffuse cones and a specular cone for the indirect light.
// Formula:    E = pi sum w_i L_i, w_i = cos_i / sum cos; specular L times the environment BRDF [Karis13]
// In:         Wave: points, hits; materials, lights, filtered voxels, world
// Out:        Wave: arrivals, gloss
// Invocation: one pixel

#include "bind/albedo.glsl"
#include "bind/cones.glsl"
#include "bind/environment.glsl"
#include "bind/gloss.glsl"
#include "bind/instances.glsl"
#include "bind/lamp_tables.glsl"
#include "bind/materials.glsl"
#include "bind/pixels.glsl"
#include "bind/wave.glsl"
#include "lib/brdf.glsl"

const int N_RING = 8;             // cones around the one along the normal

layout(local_size_x = 64) in;

layout(std430) readonly buffer Lights { Light lights[]; };

uniform int u_n_lights;
uniform bool u_has_gloss;         // whether any point mirrors
uniform bool u_has_light;         // whether there is anything that a cone could find
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

// What reflects beside the ground: f0 and roughness of a point's material.
vec4 mirror_of(Hit hit)
{
    Material m = materials[material_of(hit.instance, hit.triangle)];
    Shading shading = shading_at(m, uv_at(hit.triangle, hit.bary));
    vec3 f0 = mix(dielectric_f0(m.ior, m.specular_level) * m.specular_tint, shading.base_color, shading.metallic);
    return vec4(f0, shading.roughness);
}

void direct_light(Surface s, vec3 wo, vec4 mirror, uint seed, inout vec3 E, inout vec3 specular)
{
    float NoV = dot(s.normal, wo), alpha = max(mirror.w * mirror.w, 1e-3);
    for (int i = 0; i < u_n_lights; i++) {
        LightSample light = sample_lamp(lights[i], s.position, sobol_point(u_sample, seed + uint(i)));
        float NoL = dot(s.normal, light.wi);
        if (NoL <= 0.0 || dot(s.normal_geometric, light.wi) <= 0.0 || light.E_perp == vec3(0.0))
            continue;
        vec3 arriving = NoL * light.E_perp * (lights[i].casts_shadow != 0u ? shadow_cone(s, light) : 1.0);
        E += arriving;
        if (mirror.rgb != vec3(0.0)) {
            vec3 h = normalize(light.wi + wo);
            specular += arriving * microfacet_brdf(mirror.rgb, alpha, dot(s.normal, h), NoV, NoL, dot(wo, h));
        }
    }
}

// Radiance by a cone around the mirror direction; world: the part of it that comes from there.
vec3 specular_light(Surface s, vec3 wo, vec4 mirror, out vec3 world)
{
    vec2 ab = environment_brdf(mirror.w, dot(s.normal, wo));
    vec3 reflectance = mirror.rgb * ab.x + (mirror.rgb == vec3(0.0) ? 0.0 : ab.y);
    world = vec3(0.0);
    if (!u_specular_cone || reflectance == vec3(0.0))
        return vec3(0.0);
    vec3 L = cone_light(to_voxels(s.position), s.normal_geometric, reflect(-wo, s.normal), clamp(mirror.w * mirror.w, 0.01, 1.0), world);
    world *= reflectance;
    return reflectance * L;
}

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x;
    if (slot >= u_end)
        return;
    Point p = get_point(u_set, slot);
    if (!is_kind(p, POINT_SURFACE))
        return;
    Hit hit = get_hit(u_set, slot);
    Surface s = surface_of(p);
    ivec2 pixel = pixel_of(slot);
    vec3 wo = -hit.direction, E = vec3(0.0), E_indirect = vec3(0.0), E_world = vec3(0.0), L = vec3(0.0), L_cone = vec3(0.0), L_world = vec3(0.0);
    vec4 mirror = mirror_of(hit);
    direct_light(s, wo, mirror, hash(uint(pixel.x) + hash(uint(pixel.y) + u_seed)), E, L);
    if (u_has_light) {
        E_indirect = diffuse_cones(s, E_world);
        L_cone = specular_light(s, wo, mirror, L_world);
    }
    put_arrival(slot, Arrival(E, E_indirect, E_world));
    if (u_has_gloss)
        put_gloss(slot, Gloss(L + L_world, 0.0, L_cone - L_world, vec3(0.0), vec3(0.0)));
}
