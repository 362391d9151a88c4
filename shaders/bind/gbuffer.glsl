// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a pixel sees: the G-buffer holds a triangle and barycentrics; the surface is fetched from the scene.

#include "bind/camera.glsl"
#include "bind/geometry.glsl"
#include "bind/materials.glsl"

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
    Surface s = surface_at(v.x - 1u, v.y, uintBitsToFloat(v.zw), has_textures);
    s.normal = mapped_normal(s.material, s.uv, s.normal, s.tangent, s.bitangent, has_textures);
    if (dot(s.normal_geometric, seen.wo) < 0.0) {
        s.normal_geometric = -s.normal_geometric;
        s.normal = -s.normal;
    }
    // A shading normal that faces away would see nothing: bend it until it grazes
    float NoV = dot(s.normal, seen.wo);
    if (NoV < 1e-3)
        s.normal = normalize(s.normal + (1e-3 - NoV) * seen.wo);
    seen.surface = s;
    seen.shading = shading_at(s.material, s.uv, has_textures);
    return seen;
}
