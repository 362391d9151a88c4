// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Vector Transform node: steps between the spaces of object, world and camera, which looks along +z.

#include "nodes/bounded.glsl"
#include "nodes/coordinates.glsl"

const vec3 LOOKING = vec3(1.0, 1.0, -1.0);  // between the view, which looks along -z, and that

vec3 point_object_from_world(Geo g, vec3 p)
{
    return bounded3(point_to_object(g, p));
}

vec3 point_world_from_object(Geo g, vec3 p)
{
    return has_object(g) ? bounded3(world_from_object(g) * p + object_location(g)) : p;
}

vec3 point_camera_from_world(Geo g, vec3 p)
{
    return bounded3(LOOKING * (u_view_from_world * vec4(p - u_centre, 1.0)).xyz);
}

vec3 point_world_from_camera(Geo g, vec3 p)
{
    return bounded3(inverse_of(mat3(u_view_from_world)) * (LOOKING * p - u_view_from_world[3].xyz) + u_centre);
}

vec3 vector_object_from_world(Geo g, vec3 v)
{
    return bounded3(direction_to_object(g, v));
}

vec3 vector_world_from_object(Geo g, vec3 v)
{
    return bounded3(direction_to_world(g, v));
}

vec3 vector_camera_from_world(Geo g, vec3 v)
{
    return bounded3(LOOKING * (mat3(u_view_from_world) * v));
}

vec3 vector_world_from_camera(Geo g, vec3 v)
{
    return bounded3(inverse_of(mat3(u_view_from_world)) * (LOOKING * v));
}

// Normals go by inverse transposes, as unit vectors.
vec3 normal_object_from_world(Geo g, vec3 n)
{
    return has_object(g) ? unit_of(bounded3(transpose(world_from_object(g)) * unit_of(n))) : n;
}

vec3 normal_world_from_object(Geo g, vec3 n)
{
    return has_object(g) ? unit_of(bounded3(transpose(inverse_of(world_from_object(g))) * unit_of(n))) : n;
}

vec3 normal_camera_from_world(Geo g, vec3 n)
{
    return unit_of(LOOKING * (transpose(inverse_of(mat3(u_view_from_world))) * unit_of(n)));
}

vec3 normal_world_from_camera(Geo g, vec3 n)
{
    return unit_of(transpose(mat3(u_view_from_world)) * (LOOKING * unit_of(n)));
}
