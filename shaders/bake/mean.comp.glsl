// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    about how much light each triangle sends out: the mean over its cells, or over a thousand of them.
// In:         u_baked
// Out:        Means: radiance, mean of the colours
// Invocation: one triangle of one instance

#include "bind/baked.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer Means { float means[]; };

uniform uint u_first;
uniform uint u_end;

const uint MOST = 1024u;

void main()
{
    uint work = u_first + gl_GlobalInvocationID.x;
    if (work >= u_end)
        return;
    uvec4 rows = texelFetch(u_baked, int(work >> 1u));
    uvec2 row = (work & 1u) == 0u ? rows.xy : rows.zw;
    uint n = row.y * row.y, step = max(n / MOST, 1u), count = 0u;
    float sum = 0.0;
    for (uint i = 0u; i < n; i += step, count++) {
        Cell c = unpacked_cell(texelFetch(u_baked, int(u_n_rows + row.x + i)));
        sum += c.opacity * dot(c.emission, vec3(1.0 / 3.0));
    }
    means[work] = sum / float(max(count, 1u));
}
