// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: which pixel a slot is of: one part of the picture is worked on at a time, in tiles of 8 by 8 pixels, one after
// another.

#include "bind/camera.glsl"
#include "lib/math.glsl"

uniform uint u_start;  // slots of the parts before this one

ivec2 pixel_of(uint slot)
{
    return tiled_pixel(u_start + slot, u_size);
}

bool is_outside(ivec2 pixel)
{
    return any(greaterThanEqual(pixel, u_size));
}
