// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light of a source whose material is a compiled node tree: of the world in every direction of an
//             equirectangular image, or of given points of the world or a lamp.
// In:         Asked: three vec4 a point: position and metres of the ray, normal and u, direction to where it is seen from and v
// Out:        Radiance: [W m^-2 sr^-1], or for lamps what multiplies theirs
// Invocation: one texel or point

#include "bind/geo.glsl"
#include "lib/math.glsl"
#include "nodes/closures.glsl"
#include "nodes/tree.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer Asked { vec4 asked[]; };
layout(std430) writeonly buffer Radiance { vec4 radiance[]; };

uniform uint u_first;
uniform uint u_end;
uniform ivec2 u_size;  // of the image; 0 for points
uniform uint u_rays;   // RAY_*

// What the world's tree sees of a ray along d, as Cycles has it.
Geo geo_of_world(vec3 d)
{
    return Geo(BVH_NONE, 0u, vec2(0.0), d, -d, -d, -d, false, 1e30, u_rays, 0u, 0u, vec2(0.0), vec2(0.0));
}

Geo geo_of_texel(uint i)
{
    vec2 uv = (vec2(int(i) % u_size.x, int(i) / u_size.x) + 0.5) / vec2(u_size);
    float azimuth = (0.5 - uv.x) * 2.0 * PI, latitude = (uv.y - 0.5) * PI;
    return geo_of_world(vec3(cos(latitude) * vec2(cos(azimuth), sin(azimuth)), sin(latitude)));
}

Geo geo_of_point(uint i)
{
    vec4 position = asked[3u * i], normal = asked[3u * i + 1u], wo = asked[3u * i + 2u];
    vec2 bary = vec2(wo.w, 1.0 - normal.w - wo.w);  // of which Parametric makes u and v
    return Geo(BVH_NONE, 0u, bary, position.xyz, normal.xyz, normal.xyz, wo.xyz, false, position.w, u_rays,
               0u, 0u, vec2(0.0), vec2(0.0));
}

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    Geo g = geo_of_point(i);
    if (u_size.x > 0)
        g = geo_of_texel(i);
    Closures c = no_closures(g, 0.0, true);
    surface(g, c);
    bool is_finite = !any(isnan(c.emission)) && !any(isinf(c.emission));
    radiance[i] = vec4(is_finite ? c.emission : vec3(0.0), 1.0);
}
