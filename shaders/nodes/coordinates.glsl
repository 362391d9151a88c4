// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: outputs of Texture Coordinate and Camera Data. Where no surface is met, points are directions.

#include "bind/attributes.glsl"

uniform mat4 u_view_from_world;  // from metres relative to u_centre; the view looks along -z
uniform mat4 u_clip_from_view;

vec3 generated_of_point(Geo g)
{
    return generated_at(g);
}

vec3 position_in_object(Geo g)
{
    return position_os(g);
}

// In the space of another object, whose rows of object_from_world these are.
vec3 position_in_other(Geo g, vec3 x, float tx, vec3 y, float ty, vec3 z, float tz)
{
    return vec3(dot(x, g.position) + tx, dot(y, g.position) + ty, dot(z, g.position) + tz);
}

vec3 normal_in_object(Geo g)
{
    return normal_to_object(g, g.normal);
}

vec3 in_view(Geo g)
{
    return (u_view_from_world * vec4(g.position - u_centre, 1.0)).xyz;
}

vec3 position_in_camera(Geo g)
{
    vec3 p = in_view(g);
    return vec3(p.xy, -p.z);
}

vec3 position_in_window(Geo g)
{
    vec4 p = u_clip_from_view * vec4(in_view(g), 1.0);
    return p.w != 0.0 ? vec3(p.xy / p.w * 0.5 + 0.5, 0.0) : vec3(0.0);
}

vec3 reflected_direction(Geo g)
{
    return has_object(g) ? 2.0 * dot(g.normal, g.wo) * g.normal - g.wo : g.wo;
}

vec3 generated_of_instancer(Geo g)
{
    return has_object(g) ? shown[g.instance].generated : vec3(0.0);
}

vec3 uv_of_instancer(Geo g)
{
    return has_object(g) ? vec3(shown[g.instance].uv, 0.0) : vec3(0.0);
}

vec3 view_vector(Geo g)
{
    return unit_or_zero(position_in_camera(g));
}

float view_depth(Geo g)
{
    return position_in_camera(g).z;
}

float view_distance(Geo g)
{
    return length(position_in_camera(g));
}
