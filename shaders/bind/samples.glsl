// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: how many samples a pixel has.

uniform float u_n_samples;

float n_samples(ivec2 pixel)
{
    return u_n_samples;
}
