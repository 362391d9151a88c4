// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    hits in the middle of cells, seen from straight ahead, for trees to be evaluated at.
// In:         triangles, materials, Rows
// Out:        Wave: hits
// Invocation: one cell

#include "bake/triangle.glsl"
#include "bind/baked.glsl"
#include "bind/wave.glsl"

layout(std430) readonly buffer Rows { uvec2 rows[]; };

uniform uint u_n_work;
uniform uint u_start;  // cells of the parts before this one

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x, cell = u_start + slot;
    if (slot >= u_end)
        return;
    uint low = 0u, high = u_n_work;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (rows[middle].x <= cell)
            low = middle;
        else
            high = middle;
    }
    uint instance, triangle;
    triangle_of(low, instance, triangle);
    vec2 bary = bary_of_cell(cell - rows[low].x, rows[low].y);
    vec3 n = handedness(instances[instance]) * normal_of(instance, triangle);
    n = dot(n, n) > 0.0 ? normalize(n) : vec3(0.0, 0.0, 1.0);
    put_hit(u_set, slot, Hit(instance, triangle, bary, -n, 0.0, 0u, hash(cell), 1.0, 1.0));
}
