// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the world's light: a colour times an equirectangular image with mip levels.

#include "lib/math.glsl"

uniform sampler2D u_env;
uniform vec3 u_world_radiance;
uniform mat3 u_env_from_world;
uniform bool u_has_env;

// Where direction e, of any length, lies in the image.
vec2 image_uv(vec3 e)
{
    return vec2(0.5 - atan(e.y, e.x) / (2.0 * PI), 0.5 + atan(e.z, length(e.xy)) / PI);
}

// Radiance from unit direction d, averaged over a cone of that half angle's tangent.
vec3 world_radiance(vec3 d, float tan_half_angle)
{
    if (!u_has_env)
        return u_world_radiance;
    float texels = 2.0 * tan_half_angle / PI * float(textureSize(u_env, 0).y);
    return u_world_radiance * textureLod(u_env, image_uv(u_env_from_world * d), log2(max(texels, 1.0))).rgb;
}
