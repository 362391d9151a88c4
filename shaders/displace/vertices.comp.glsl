// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    where vertices move whose material's tree says so, one structure a program.
// In:         triangles, values; Corners: a triangle's corner for each vertex, and the vertex's own normal
// Out:        Moves: metres in object space, zero where they would not be finite
// Invocation: one vertex

#include "nodes/mover.glsl"
#include "bind/attributes.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer Corners { MovedCorner moved_corners[]; };
layout(std430) writeonly buffer Moves { vec4 moves[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    MovedCorner c = moved_corners[i];
    Instance instance = instances[c.instance];
    vec2 bary = vec2(c.corner == 1u ? 1.0 : 0.0, c.corner == 2u ? 1.0 : 0.0);
    vec3 n = normal_to_world(instance, c.normal);
    n = dot(n, n) > 0.0 ? normalize(n) : vec3(0.0, 0.0, 1.0);
    Seen seen = seen_at(c.instance, c.triangle, bary, n);
    Geo g = geo_at(seen, c.instance, c.triangle, bary, n, 0.0, 0u, 0u, c.first_value);
    g.normal = n;
    vec3 by = direction_to_object(g, displacement(g));
    moves[i] = any(isnan(by)) || any(isinf(by)) ? vec4(0.0) : vec4(by, 0.0);
}
