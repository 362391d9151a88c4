// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: how many samples a pixel has.

#include "bind/tiles.glsl"

uniform float u_n_samples;  // of pixels that are not done

float n_samples(ivec2 pixel)
{
    uint n = samples_when_done(pixel);
    return n == 0u ? u_n_samples : float(n);
}
