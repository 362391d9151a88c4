// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the world as the camera sees it: by another picture where the world's nodes tell the camera's rays from others,
//          and with the sun's disc, which is a lamp for all else.

#include "bind/environment.glsl"

uniform sampler2D u_env_seen;
uniform bool u_has_env_seen;
uniform bool u_has_color_seen;
uniform vec3 u_color_seen;
uniform vec3 u_sun_axis;       // unit
uniform float u_sun_radius;    // radians; 0 without a sun
uniform float u_sun_horizon;   // sine of the elevation below which it is hidden
uniform vec3 u_sun_middle;     // radiance of the disc's middle
uniform vec3 u_sun_slope;      // by how much that grows upwards over the radius

// Radiance of the sun's disc, darker towards its edge.
vec3 sun_seen(vec3 d)
{
    float angle = 2.0 * atan(length(d - u_sun_axis), length(d + u_sun_axis)), r = angle / u_sun_radius;
    if (r >= 1.0 || d.z < u_sun_horizon)
        return vec3(0.0);
    float height = (asin(clamp(d.z, -1.0, 1.0)) - asin(clamp(u_sun_axis.z, -1.0, 1.0))) / u_sun_radius;
    return max(u_sun_middle + height * u_sun_slope, 0.0) * (1.0 - 0.6 * (1.0 - sqrt(1.0 - r * r)));
}

// Radiance from unit direction d.
vec3 world_seen(vec3 d)
{
    vec3 sun = u_sun_radius > 0.0 ? sun_seen(d) : vec3(0.0);
    if (u_has_color_seen)
        return u_color_seen + sun;
    if (u_has_env_seen)
        return textureLod(u_env_seen, image_uv(d), 0.0).rgb + sun;
    return world_radiance(d, 0.0) + sun;
}
