// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the voxels themselves, as in the thesis's figure 5-1: the first filled texel that each pixel's ray meets.
// In:         u_attribute at mip level u_lod: rgb value times opacity, a opacity
// Out:        u_film: sums of RGBA
// Invocation: one pixel; a ray walks from texel to texel [Amanatides87]

#include "bind/camera.glsl"
#include "bind/grid.glsl"
#include "lib/math.glsl"

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2D u_film;
uniform sampler3D u_attribute;

uniform uint u_first;
uniform uint u_end;
uniform int u_lod;

// Value of the first filled texel along a ray in texel space of n^3; alpha 0 if there is none.
vec4 first_texel(vec3 o, vec3 d, int n)
{
    vec3 inv_d = 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
    vec3 enter = min(-o * inv_d, (vec3(n) - o) * inv_d), leave = max(-o * inv_d, (vec3(n) - o) * inv_d);
    float t = max(max(enter.x, max(enter.y, enter.z)), 0.0), t_end = min(leave.x, min(leave.y, leave.z));
    if (t >= t_end)
        return vec4(0.0);
    ivec3 cell = clamp(ivec3(floor(o + d * t)), ivec3(0), ivec3(n - 1)), step = ivec3(sign(d));
    vec3 next = (vec3(cell) + vec3(greaterThan(d, vec3(0.0))) - o) * inv_d;
    while (all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(n)))) {
        vec4 value = texelFetch(u_attribute, cell, u_lod);
        if (value.a > 0.0)
            return vec4(value.rgb / value.a, 1.0);
        int axis = next.x < next.y && next.x < next.z ? 0 : next.y < next.z ? 1 : 2;
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
    imageStore(u_film, pixel, imageLoad(u_film, pixel) + value);
}
