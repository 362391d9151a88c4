// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the voxels themselves, as in the thesis's figure 5-1: the first filled texel that each pixel's ray meets.
// In:         u_attribute at mip level u_lod: rgb value times opacity, a opacity
// Out:        u_film: sums of RGBA
// Invocation: one pixel; a ray walks from texel to texel [Amanatides87]

#include "bind/camera.glsl"
#include "bind/film.glsl"
#include "bind/grid.glsl"
#include "lib/math.glsl"

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2DArray u_film;
uniform sampler3D u_attribute;

uniform uint u_first;
uniform uint u_end;
uniform int u_lod;

uniform bool u_shade_faces;       // faces along x and y darker, so that a single colour still shows a shape
uniform bool u_show_opacity;      // a as grey instead of rgb
const float EDGE = 0.06;          // of a texel's side, drawn darker so that texels can be told apart
const float EDGE_SHADE = 0.6;

// Darker near the edges of the face through which the ray enters; p: entry point in texel space.
float shade(vec3 p, int axis)
{
    vec3 to_edge = 0.5 - abs(fract(p) - 0.5);
    to_edge[axis] = 1.0;
    float face = u_shade_faces ? vec3(0.75, 0.87, 1.0)[axis] : 1.0;
    return min(min(to_edge.x, to_edge.y), to_edge.z) < EDGE ? EDGE_SHADE * face : face;
}

// Value of the first filled texel along a ray in texel space of n^3; alpha 0 if there is none.
vec4 first_texel(vec3 o, vec3 d, int n)
{
    vec3 inv_d = 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
    vec3 enter = min(-o * inv_d, (vec3(n) - o) * inv_d), leave = max(-o * inv_d, (vec3(n) - o) * inv_d);
    float t = max(max(enter.x, max(enter.y, enter.z)), 0.0), t_end = min(leave.x, min(leave.y, leave.z));
    if (t >= t_end)
        return vec4(0.0);
    ivec3 cell = clamp(ivec3(floor(o + d * t)), ivec3(0), ivec3(n - 1)), step = ivec3(sign(d));
    int axis = enter.x > enter.y && enter.x > enter.z ? 0 : enter.y > enter.z ? 1 : 2;
    vec3 next = (vec3(cell) + vec3(greaterThan(d, vec3(0.0))) - o) * inv_d;
    while (all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(n)))) {
        vec4 value = texelFetch(u_attribute, cell, u_lod);
        if (value.a > 0.0)
            return vec4((u_show_opacity ? value.aaa : value.rgb / value.a) * shade(o + d * t, axis), 1.0);
        axis = next.x < next.y && next.x < next.z ? 0 : next.y < next.z ? 1 : 2;
        t = next[axis];
        cell[axis] += step[axis];
        next[axis] += abs(inv_d[axis]);
    }
    return vec4(0.0);
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)))
        return;
    vec3 origin, direction;
    camera_ray(vec2(pixel) + 0.5, origin, direction);
    float texels_per_voxel = exp2(-float(u_lod));
    vec4 value = first_texel(to_voxels(origin) * texels_per_voxel, direction, u_grid_n >> u_lod);
    ivec3 at = ivec3(pixel, u_planes[COMBINED]);
    imageStore(u_film, at, imageLoad(u_film, at) + value);
}
