// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: which tiles of 8 by 8 pixels, a workgroup each, have samples enough.

uniform usampler2D u_tiles;  // samples with which a tile was done; 0: not yet

uint samples_when_done(ivec2 pixel)
{
    return texelFetch(u_tiles, pixel / 8, 0).r;
}

bool is_done(ivec2 pixel)
{
    return samples_when_done(pixel) != 0u;
}
