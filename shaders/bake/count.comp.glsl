// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    into how many cells each triangle is cut whose material is a tree of nodes: by its area, for u_cell metres.
// In:         triangles of all instances, materials
// Out:        Cells: k^2, or zero
// Invocation: one triangle of one instance

#include "bake/triangle.glsl"

layout(std430) writeonly buffer Cells { uint cells[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint work = u_first + gl_GlobalInvocationID.x;
    if (work >= u_end)
        return;
    uint k = edge_cells(work);
    cells[work] = k * k;
}
