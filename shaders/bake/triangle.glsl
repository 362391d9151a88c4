// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the triangles that are baked, and how finely.

#include "bind/material_rows.glsl"
#include "bind/geometry.glsl"

layout(local_size_x = 64) in;

uniform uint u_n_instances;
uniform float u_cell;  // metres, of a cell's side

const uint MOST_CELLS = 1024u;  // along an edge

void triangle_of(uint work, out uint instance, out uint triangle)
{
    instance = instance_of_work(work, u_n_instances);
    triangle = instances[instance].first_triangle + work - instances[instance].first_work;
}

// k: cells along each edge of a triangle; 0 for one whose material is no tree.
uint edge_cells(uint work)
{
    uint instance, triangle;
    triangle_of(work, instance, triangle);
    Material m = materials[material_of(instance, triangle)];
    if (m.program < PROGRAM_TREE || u_cell == 0.0)
        return 0u;
    float k = sqrt(length(normal_of(instance, triangle))) * m.detail / u_cell;
    return uint(clamp(round(k), 1.0, float(MOST_CELLS)));
}
