// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the picture's size and the rays through it.

uniform mat4 u_world_from_clip;  // world relative to the grid's centre
uniform ivec2 u_size;            // pixels

// Ray of a picture position in pixels: a point on the near plane and the direction away from the eye.
void camera_ray(vec2 pixel, out vec3 origin, out vec3 direction)
{
    vec2 ndc = pixel / vec2(u_size) * 2.0 - 1.0;
    vec4 near = u_world_from_clip * vec4(ndc, -1.0, 1.0), far = u_world_from_clip * vec4(ndc, 1.0, 1.0);
    origin = near.xyz / near.w;
    direction = normalize(far.xyz / far.w - origin);
}
