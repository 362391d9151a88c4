// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    which triangle each pixel sees, by rays from the camera: what the rasteriser finds, without its change of
//             gear between two dispatches.
// In:         camera, BVH, tiles that are done
// Out:        u_seen: instance + 1 (0: nothing), triangle, barycentrics of the second and third corner as float bits
// Invocation: one pixel

#include "bind/camera.glsl"
#include "bind/tiles.glsl"
#include "bind/trace.glsl"

layout(rgba32ui) uniform writeonly uimage2D u_seen;

uniform uint u_first;
uniform uint u_end;
uniform float u_depth;  // from the near to the far plane, in lengths of the direction that u_ray_direction gives

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    ivec2 pixel = tiled_pixel(index, u_size);
    if (index >= u_end || any(greaterThanEqual(pixel, u_size)) || is_done(pixel))
        return;
    vec3 at = clip_position(vec2(pixel) + 0.5);
    Hit hit;
    bool is_hit = trace_closest(u_ray_origin * at, u_ray_direction * at, u_depth, 0u, hit);
    imageStore(u_seen, pixel, is_hit ? uvec4(hit.instance + 1u, hit.triangle, floatBitsToUint(hit.bary)) : uvec4(0u));
}
