// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Environment Texture: an image of all directions.

#include "bind/textures.glsl"
#include "lib/math.glsl"

vec3 environment_texture(vec3 direction, uint image, bool closest)
{
    float azimuth = direction.x != 0.0 || direction.y != 0.0 ? atan(direction.y, direction.x) : 0.0;
    float latitude = dot(direction, direction) > 0.0 ? atan(direction.z, length(direction.xy)) : 0.0;
    return picture_color(image, vec2(0.5 - azimuth / (2.0 * PI), 0.5 + latitude / PI), EXTENSION_REPEAT, closest, false).rgb;
}

// As a ball that mirrors everything shows it, seen along +Y.
vec3 environment_mirror_ball(vec3 direction, uint image, bool closest)
{
    float size = length(direction);
    vec3 d = size > 0.0 ? direction / size : vec3(0.0);
    d.y -= 1.0;
    float scale = 2.0 * sqrt(max(-0.5 * d.y, 0.0));
    vec2 uv = scale > 0.0 ? 0.5 * (d.xz / scale + 1.0) : vec2(0.5);
    return picture_color(image, uv, EXTENSION_REPEAT, closest, false).rgb;
}
