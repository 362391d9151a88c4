// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    light of emissive triangles, drawn for the sides of surfels, as lights/draw does for points.
// In:         Surfels, emissive triangles, materials
// Out:        Draws, without their shadows
// Invocation: one side of one surfel

#include "bind/emitter_draws.glsl"
#include "cache/side.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer Draws { LightDraw draws[]; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_start;
uniform uint u_stride;
uniform int u_n_points;

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x, side = u_start + slot;
    if (slot >= u_end)
        return;
    Surface s = surface_of_side(side);
    for (int i = 0; i < u_n_points * u_n_emitter_draws; i++) {
        int point = i / u_n_emitter_draws, k = i % u_n_emitter_draws;
        draws[uint(i) * u_stride + slot] = draw_emitter(k, s.position, s.normal, uint(point), hash(side));
    }
}
