// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that leaves each pixel towards the eye, added to the film.
// Formula:    L = Le + rho_d / pi (E_direct + E_indirect) + L_glossy + L_transmission; without a surface, the world
// In:         G-buffer, scene, world, u_incident
// Out:        u_film: sums in the layers that are asked for, of tiles that are not done
// Invocation: one pixel

#include "bind/film.glsl"
#include "bind/gbuffer.glsl"
#include "bind/environment.glsl"
#include "bind/incident.glsl"
#include "bind/principled.glsl"
#include "bind/tiles.glsl"

const bool HAS_TEXTURES = false;

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2DArray u_film;

uniform uint u_first;
uniform uint u_end;
uniform bool u_film_transparent;
uniform uint u_sample;

Bsdf bsdf_of(Seen seen)
{
    Surface s = seen.surface;
    return principled(materials[s.material], seen.shading, dot(s.normal, seen.wo), s.is_back);
}

void add(ivec2 pixel, int plane, vec4 value)
{
    if (plane < 0)
        return;
    ivec3 at = ivec3(pixel, plane);
    imageStore(u_film, at, imageLoad(u_film, at) + value);
}

float luminance_squared(vec3 c)
{
    return luminance(c) * luminance(c);
}

vec3 add_diffuse(ivec2 pixel, vec3 rho)
{
    vec3 direct = arrived(pixel, INCIDENT_DIFFUSE_DIRECT).rgb, indirect = arrived(pixel, INCIDENT_DIFFUSE_INDIRECT).rgb;
    add(pixel, PLANE_DIFFUSE_DIRECT, vec4(rho / PI * direct, luminance_squared(direct)));
    add(pixel, PLANE_DIFFUSE_INDIRECT, vec4(rho / PI * indirect, luminance_squared(indirect)));
    add(pixel, PLANE_DIFFUSE_FOUND, vec4(rho / PI * arrived(pixel, INCIDENT_DIFFUSE_FOUND).rgb, 0.0));
    add(pixel, PLANE_DIFFUSE_COLOR, vec4(rho, 1.0));
    return rho / PI * (direct + indirect);
}

vec3 add_glossy(ivec2 pixel, vec3 albedo, float alpha)
{
    vec4 indirect = arrived(pixel, INCIDENT_GLOSSY_INDIRECT);
    vec3 direct = arrived(pixel, INCIDENT_GLOSSY_DIRECT).rgb, without_color = 1.0 / max(albedo, MIN_ALBEDO);
    add(pixel, PLANE_GLOSSY_DIRECT, vec4(direct, luminance_squared(direct * without_color)));
    add(pixel, PLANE_GLOSSY_INDIRECT, vec4(indirect.rgb, luminance_squared(indirect.rgb * without_color)));
    add(pixel, PLANE_GLOSSY_COLOR, vec4(albedo, alpha * indirect.a));
    return direct + indirect.rgb;
}

vec3 add_transmission(ivec2 pixel, vec3 albedo)
{
    vec3 direct = arrived(pixel, INCIDENT_TRANSMISSION_DIRECT).rgb;
    vec3 indirect = arrived(pixel, INCIDENT_TRANSMISSION_INDIRECT).rgb;
    add(pixel, PLANE_TRANSMISSION_DIRECT, vec4(direct, 0.0));
    add(pixel, PLANE_TRANSMISSION_INDIRECT, vec4(indirect, 0.0));
    add(pixel, PLANE_TRANSMISSION_COLOR, vec4(albedo, 0.0));
    return direct + indirect;
}

// Whether a sample belongs to the half of them by which noise is measured. Every second one would not do: in a sequence
// of base 2 these lie in one half of the square. Of pairs, two in four, both halves are spread as all are [Christensen18].
bool is_of_half(uint number)
{
    return bitCount(number & 0xaaaaaaaau) % 2 == 1;
}

void add_picture(ivec2 pixel, vec4 color)
{
    add(pixel, PLANE_COMBINED, color);
    if (is_of_half(u_sample))
        add(pixel, PLANE_HALF, color);
}

void add_place(ivec2 pixel, Surface s)
{
    vec3 eye, d;
    camera_ray(vec2(pixel) + 0.5, eye, d);
    add(pixel, PLANE_NORMAL_DEPTH, vec4(s.normal, distance(eye, s.position)));
    if (u_sample == 0u)
        add(pixel, PLANE_POSITION, vec4(s.position, 1.0));
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)) || is_done(pixel))
        return;
    for (int plane = 0; plane < N_PLANES && u_sample == 0u; plane++)
        imageStore(u_film, ivec3(pixel, plane), vec4(0.0));
    Seen seen = seen_at(pixel, HAS_TEXTURES);
    if (!seen.hit) {
        vec3 world = world_radiance(-seen.wo, 0.0);
        add(pixel, PLANE_ENVIRONMENT, vec4(world, 0.0));
        vec4 shown = u_film_transparent ? vec4(0.0) : vec4(world, 1.0);
        add(pixel, PLANE_ALBEDO, vec4(shown.rgb, 0.0));
        add_picture(pixel, shown);
        return;
    }
    vec3 L = seen.shading.emission, albedo = L;
    if (HAS_SPECULAR) {
        Bsdf b = bsdf_of(seen);
        albedo += b.diffuse + b.glossy + b.transmission;
        L += add_diffuse(pixel, b.diffuse) + add_glossy(pixel, b.glossy, b.alpha) + add_transmission(pixel, b.transmission);
    } else {
        albedo += seen.shading.base_color;
        L += add_diffuse(pixel, seen.shading.base_color);
    }
    add(pixel, PLANE_EMISSION, vec4(seen.shading.emission, 0.0));
    add(pixel, PLANE_ALBEDO, vec4(albedo, 0.0));
    add_picture(pixel, vec4(L, 1.0));
    add_place(pixel, seen.surface);
}
