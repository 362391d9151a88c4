// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that leaves each pixel towards the eye, added to the film.
// Formula:    L = Le + rho_d / pi (E_direct + E_indirect) + L_specular; a pixel without a surface shows the world
// In:         G-buffer, scene, world, incident light
// Out:        u_film: sums in the layers PLANE_*; denoise/compose divides by the number of samples
// Invocation: one pixel

#include "bind/gbuffer.glsl"
#include "bind/environment.glsl"
#include "lib/brdf.glsl"

const bool HAS_TEXTURES = false;
const bool HAS_SPECULAR = true;

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2DArray u_film;
uniform sampler2D u_irradiance_direct;
uniform sampler2D u_irradiance_indirect;
uniform sampler2D u_specular;

uniform uint u_first;
uniform uint u_end;
uniform bool u_film_transparent;

// Diffuse reflectance: the base colour's part that is neither metal nor glass, under a layer that reflects the rest.
vec3 diffuse_albedo(Seen seen)
{
    Material m = materials[seen.surface.material];
    vec3 rho = seen.shading.base_color * ((1.0 - seen.shading.metallic) * (1.0 - m.transmission));
    if (!HAS_SPECULAR || m.specular_level == 0.0)
        return rho;
    vec2 ab = environment_brdf(seen.shading.roughness, dot(seen.surface.normal, seen.wo));
    return rho * max(1.0 - (dielectric_f0(m.ior, m.specular_level) * ab.x + ab.y), 0.0);
}

void add(ivec2 pixel, uint plane, vec4 value)
{
    ivec3 at = ivec3(pixel, int(plane));
    imageStore(u_film, at, imageLoad(u_film, at) + value);
}

float luminance_squared(vec3 c)
{
    float y = dot(c, vec3(0.2126, 0.7152, 0.0722));
    return y * y;
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    Seen seen = seen_at(pixel, HAS_TEXTURES);
    vec4 color = vec4(0.0);
    if (seen.hit) {
        vec3 direct = texelFetch(u_irradiance_direct, pixel, 0).rgb, indirect = texelFetch(u_irradiance_indirect, pixel, 0).rgb;
        vec3 rho = diffuse_albedo(seen), eye, d;
        camera_ray(vec2(pixel) + 0.5, eye, d);
        color = vec4(seen.shading.emission + rho * (direct + indirect) / PI + texelFetch(u_specular, pixel, 0).rgb, 1.0);
        add(pixel, PLANE_DIFFUSE_DIRECT, vec4(rho / PI * direct, luminance_squared(direct)));
        add(pixel, PLANE_DIFFUSE_INDIRECT, vec4(rho / PI * indirect, luminance_squared(indirect)));
        add(pixel, PLANE_DIFFUSE_COLOR, vec4(rho, 1.0));
        add(pixel, PLANE_NORMAL_DEPTH, vec4(seen.surface.normal, distance(eye, seen.surface.position)));
    } else if (!u_film_transparent) {
        color = vec4(world_radiance(-seen.wo, 0.0), 1.0);
    }
    add(pixel, PLANE_COMBINED, color);
}
