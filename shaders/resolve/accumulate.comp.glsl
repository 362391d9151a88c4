// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that leaves each pixel towards the eye, added to the film.
// Formula:    L = Le + rho_d / pi (E_direct + E_indirect) + L_glossy + L_transmission; without a surface, the world; in a holdout, nothing
// In:         Wave: points, lobes, arrivals, gloss; world
// Out:        u_film: sums in the layers that are asked for, of tiles that are not done
// Invocation: one pixel

#include "bind/film.glsl"
#include "bind/gloss.glsl"
#include "bind/lobes.glsl"
#include "bind/pixels.glsl"
#include "bind/world_seen.glsl"

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2DArray u_film;

uniform int u_n_planes;
uniform bool u_film_transparent;
uniform uint u_sample;
uniform bool u_has_lobes;  // whether any point can have them

void add(ivec2 pixel, int plane, vec4 value)
{
    if (u_planes[plane] < 0)
        return;
    ivec3 at = ivec3(pixel, u_planes[plane]);
    imageStore(u_film, at, imageLoad(u_film, at) + value);
}

float luminance_squared(vec3 c)
{
    return luminance(c) * luminance(c);
}

vec3 add_diffuse(ivec2 pixel, vec3 rho, Arrival E)
{
    add(pixel, DIFFUSE_DIRECT, vec4(rho / PI * E.direct, luminance_squared(E.direct)));
    add(pixel, DIFFUSE_INDIRECT, vec4(rho / PI * E.indirect, luminance_squared(E.indirect)));
    add(pixel, DIFFUSE_FOUND, vec4(rho / PI * E.found, 0.0));
    add(pixel, DIFFUSE_COLOR, vec4(rho, 1.0));
    return rho / PI * (E.direct + E.indirect);
}

vec3 add_specular(ivec2 pixel, vec3 glossy, vec3 transmission, float alpha, Gloss g)
{
    vec3 without_color = 1.0 / max(glossy, MIN_ALBEDO);
    add(pixel, GLOSSY_DIRECT, vec4(g.glossy_direct, luminance_squared(g.glossy_direct * without_color)));
    add(pixel, GLOSSY_INDIRECT, vec4(g.glossy_indirect, luminance_squared(g.glossy_indirect * without_color)));
    add(pixel, GLOSSY_COLOR, vec4(glossy, alpha * g.apartness));
    add(pixel, TRANSMISSION_DIRECT, vec4(g.transmission_direct, 0.0));
    add(pixel, TRANSMISSION_INDIRECT, vec4(g.transmission_indirect, 0.0));
    add(pixel, TRANSMISSION_COLOR, vec4(transmission, 0.0));
    return g.glossy_direct + g.glossy_indirect + g.transmission_direct + g.transmission_indirect;
}

// Whether a sample belongs to the half of them by which noise is measured. Every second one would not do: in a sequence
// of base 2 these lie in one half of the square. Of pairs, two in four, both halves are spread as all are [Christensen18].
bool is_of_half(uint number)
{
    return bitCount(number & 0xaaaaaaaau) % 2 == 1;
}

void add_picture(ivec2 pixel, vec4 color)
{
    add(pixel, COMBINED, color);
    if (is_of_half(u_sample))
        add(pixel, HALF, color);
}

void add_world(ivec2 pixel)
{
    vec3 origin, direction;
    camera_ray(vec2(pixel) + 0.5, origin, direction);
    vec3 world = world_seen(direction);
    vec4 shown = u_film_transparent ? vec4(0.0) : vec4(world, 1.0);
    add(pixel, ENVIRONMENT, vec4(world, 0.0));
    add(pixel, ALBEDO, vec4(shown.rgb, 0.0));
    add_picture(pixel, shown);
}

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x;
    if (slot >= u_end)
        return;
    ivec2 pixel = pixel_of(slot);
    Point p = get_point(u_set, slot);
    if (is_outside(pixel) || is_kind(p, POINT_DONE))
        return;
    for (int layer = 0; layer < u_n_planes && u_sample == 0u; layer++)
        imageStore(u_film, ivec3(pixel, layer), vec4(0.0));
    if (is_kind(p, POINT_HOLDOUT)) {
        add_picture(pixel, vec4(0.0));
        return;
    }
    if (!is_kind(p, POINT_SURFACE)) {
        add_world(pixel);
        return;
    }
    vec3 albedo = p.emission + p.diffuse, L = p.emission + add_diffuse(pixel, p.diffuse, get_arrival(slot));
    if (u_has_lobes && is_kind(p, POINT_LOBES)) {
        Bsdf b = get_lobes(u_set, slot);
        albedo += b.glossy + b.transmission;
        L += add_specular(pixel, b.glossy, b.transmission, b.alpha.x, get_gloss(slot));
    }
    add(pixel, EMISSION, vec4(p.emission, 0.0));
    add(pixel, ALBEDO, vec4(albedo, 0.0));
    add_picture(pixel, vec4(L, 1.0));
    add(pixel, NORMAL_DEPTH, vec4(is_kind(p, POINT_TURNED) ? -p.normal : p.normal, p.t));
    if (u_sample == 0u)
        add(pixel, POSITION, vec4(p.position, 1.0));
}
