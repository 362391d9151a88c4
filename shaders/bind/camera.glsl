// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the picture's size and the rays through it.

uniform mat3 u_ray_origin;     // from (x, y, 1) in clip space to the near plane, metres relative to the grid's centre
uniform mat3 u_ray_direction;  // to a direction away from the eye, any length
uniform ivec2 u_size;          // pixels

// (x, y, 1) in clip space of a picture position in pixels.
vec3 clip_position(vec2 pixel)
{
    return vec3(pixel / vec2(u_size) * 2.0 - 1.0, 1.0);
}

// Ray of a picture position in pixels: a point on the near plane and the direction away from the eye.
void camera_ray(vec2 pixel, out vec3 origin, out vec3 direction)
{
    vec3 at = clip_position(pixel);
    origin = u_ray_origin * at;
    direction = normalize(u_ray_direction * at);
}
