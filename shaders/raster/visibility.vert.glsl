// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    project the corners of all instances of one mesh.
// In:         triangles by gl_VertexID / 3, instances by gl_InstanceID
// Out:        clip-space position; instance, triangle and barycentrics for the fragment
// Invocation: one corner of one triangle of one instance

#include "bind/geometry.glsl"

uniform mat4 u_clip_from_world;
uniform int u_first_instance;
uniform int u_first_triangle;

flat out uvec2 v_instance_triangle;
out vec2 v_bary;

void main()
{
    uint instance = uint(u_first_instance + gl_InstanceID), triangle = uint(u_first_triangle + gl_VertexID / 3);
    int corner = gl_VertexID % 3;
    v_instance_triangle = uvec2(instance, triangle);
    v_bary = vec2(corner == 1, corner == 2);
    gl_Position = u_clip_from_world * vec4(vertex_ws(instance, triangles[triangle][corner]), 1.0);
}
