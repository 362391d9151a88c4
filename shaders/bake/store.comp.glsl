// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    what trees gave for the cells, packed.
// In:         Wave: points, with mean albedos, emission, as their chance opacity, as t what goes through
// Out:        Baked: cells; Brightest: the highest radiance (bits of a positive float)
// Invocation: one cell

#include "bind/baked.glsl"
#include "bind/wave.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer Baked { uvec4 baked[]; };
layout(std430) buffer Brightest { uint brightest[]; };

uniform uint u_start;

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x;
    if (slot >= u_end)
        return;
    Point p = get_point(u_set, slot);
    baked[u_n_rows + u_start + slot] = packed_cell(Cell(p.diffuse, p.chance, p.emission, p.t));
    float most = max(p.emission.r, max(p.emission.g, p.emission.b));
    if (most > 0.0 && !isinf(most))
        atomicMax(brightest[0], floatBitsToUint(most));
}
