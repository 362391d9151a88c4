// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: where the scene's triangles are. Positions are metres relative to the grid's centre.

#include "bind/instances.glsl"

layout(std430) readonly buffer Positions { float positions[]; };  // xyz of each vertex, object space

vec3 to_world(Instance instance, vec3 p_os)
{
    vec4 p = vec4(p_os, 1.0);
    return vec3(dot(instance.row_x, p), dot(instance.row_y, p), dot(instance.row_z, p));
}

vec3 vertex_os(uint vertex)
{
    return vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
}

vec3 vertex_ws(uint instance, uint vertex)
{
    return to_world(instances[instance], vertex_os(vertex));
}

// A normal of a triangle in world space, of any length and on either side.
vec3 normal_of(uint instance, uint triangle)
{
    uvec4 corners = triangles[triangle];
    vec3 a = vertex_ws(instance, corners.x);
    return cross(vertex_ws(instance, corners.y) - a, vertex_ws(instance, corners.z) - a);
}
