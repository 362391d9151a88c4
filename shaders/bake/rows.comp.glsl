// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    where the cells of each triangle lie.
// In:         triangles of all instances, materials; Firsts: cells of all triangles before each one
// Out:        Rows: first cell, k
// Invocation: one triangle of one instance

#include "bake/triangle.glsl"

layout(std430) readonly buffer Firsts { uint firsts[]; };
layout(std430) writeonly buffer Rows { uvec2 rows[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint work = u_first + gl_GlobalInvocationID.x;
    if (work < u_end)
        rows[work] = uvec2(firsts[work], edge_cells(work));
}
