// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    which triangle each pixel sees, by rays from the camera: what the rasteriser finds, without its change of
//             gear between two dispatches.
// In:         camera, BVH, tiles that are done
// Out:        Wave: hits
// Invocation: one pixel

#include "bind/trace.glsl"
#include "raster/eye.glsl"

uniform float u_depth;  // from the near to the far plane, in lengths of the direction that u_ray_direction gives

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
    vec3 at = clip_position(vec2(pixel) + 0.5), d = u_ray_direction * at;
    Crossing c;
    trace_closest(u_ray_origin * at, d, u_depth, 0u, c);
    put_hit(u_set, slot, eye_hit(pixel, c.t * length(d), c.instance, c.triangle, c.bary));
}
