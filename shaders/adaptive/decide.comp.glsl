// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    which tiles are done: those in which, and in whose neighbours, no pixel is noisier than allowed. Once done, a tile
//             stays so.
// In:         Errors of measure
// Out:        u_done: the number of samples of a tile that is done now; Running: how many are not, an integer sum
// Invocation: one tile

layout(local_size_x = 64) in;

layout(std430) readonly buffer Errors { float errors[]; };
layout(std430) buffer Running { uint n_running; };
layout(r32ui) uniform uimage2D u_done;

uniform uint u_first;
uniform uint u_end;
uniform ivec2 u_n_tiles;
uniform uint u_n_samples;
uniform float u_threshold;

bool is_quiet(ivec2 tile)
{
    for (int y = max(tile.y - 1, 0); y <= min(tile.y + 1, u_n_tiles.y - 1); y++)
        for (int x = max(tile.x - 1, 0); x <= min(tile.x + 1, u_n_tiles.x - 1); x++)
            if (!(errors[y * u_n_tiles.x + x] <= u_threshold))
                return false;
    return true;
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    if (index >= u_end)
        return;
    ivec2 tile = ivec2(index % uint(u_n_tiles.x), index / uint(u_n_tiles.x));
    if (imageLoad(u_done, tile).r != 0u)
        return;
    if (is_quiet(tile))
        imageStore(u_done, tile, uvec4(u_n_samples));
    else
        atomicAdd(n_running, 1u);
}
