// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what the rasteriser saw, as hits of rays.
// In:         u_visibility: instance + 1 (0: nothing), triangle, barycentrics of the second and third corner as float bits
// Out:        Wave: hits
// Invocation: one pixel

#include "bind/geometry.glsl"
#include "raster/eye.glsl"

layout(local_size_x = 64) in;

uniform usampler2D u_visibility;

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x;
    if (slot >= u_end)
        return;
    ivec2 pixel = pixel_of(slot);
    if (is_outside(pixel) || is_done(pixel)) {
        put_no_hit(u_set, slot, HIT_DONE);
        return;
    }
    uvec4 v = texelFetch(u_visibility, pixel, 0);
    if (v.x == 0u) {
        put_hit(u_set, slot, eye_hit(pixel, INFINITE, BVH_NONE, 0u, vec2(0.0)));
        return;
    }
    vec3 origin, d;
    camera_ray(vec2(pixel) + 0.5, origin, d);
    uvec4 corners = triangles[v.y];
    vec2 bary = uintBitsToFloat(v.zw);
    vec3 a = vertex_ws(v.x - 1u, corners.x), ab = vertex_ws(v.x - 1u, corners.y) - a, ac = vertex_ws(v.x - 1u, corners.z) - a;
    put_hit(u_set, slot, eye_hit(pixel, distance(origin, a + bary.x * ab + bary.y * ac), v.x - 1u, v.y, bary));
}
