// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one mip level from the one below: the mean of eight texels, light and opacity alike.
// In:         u_fine
// Out:        u_coarse, u_n texels a side
// Invocation: one texel of u_coarse

layout(local_size_x = 64) in;

layout(rgba16f) uniform readonly image3D u_fine;
layout(rgba16f) uniform writeonly image3D u_coarse;

uniform uint u_first;
uniform uint u_end;
uniform int u_n;

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    if (index >= u_end)
        return;
    int i = int(index);
    ivec3 at = ivec3(i % u_n, i / u_n % u_n, i / (u_n * u_n));
    vec4 sum = vec4(0.0);
    for (int child = 0; child < 8; child++)
        sum += imageLoad(u_fine, 2 * at + ivec3(child & 1, child >> 1 & 1, child >> 2));
    imageStore(u_coarse, at, sum / 8.0);
}
