// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a pixel sees: the G-buffer holds a triangle and barycentrics; the surface is fetched from the scene.

#include "bind/camera.glsl"
#include "bind/surface.glsl"

uniform usampler2D u_visibility;

struct Seen {
    bool hit;
    Surface surface;
    Shading shading;
    vec3 wo;  // unit, towards the eye
};

// The surface seen through a pixel's centre; its normals are turned towards the eye.
Seen seen_at(ivec2 pixel, bool has_textures)
{
    uvec4 v = texelFetch(u_visibility, pixel, 0);
    Seen seen;
    vec3 origin, direction;
    camera_ray(vec2(pixel) + 0.5, origin, direction);
    seen.wo = -direction;
    seen.hit = v.x != 0u;
    if (!seen.hit)
        return seen;
    seen.surface = seen_surface(v.x - 1u, v.y, uintBitsToFloat(v.zw), seen.wo, has_textures);
    seen.shading = shading_at(seen.surface.material, seen.surface.uv, has_textures);
    return seen;
}
