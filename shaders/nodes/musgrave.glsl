// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what Blender's Musgrave texture, which there was until 4.0, gives to the noise that came after it.

#include "nodes/texture_space.glsl"

float musgrave_lacunarity(float lacunarity)
{
    return max(lacunarity, 1e-5);
}

float musgrave_roughness(float dimension, float lacunarity)
{
    return pow(lacunarity, -max(dimension, 1e-5));
}

// keeps_part: a number of octaves below 1 is a part of the second one
float musgrave_detail(bool keeps_part, float octaves)
{
    octaves = clamp(octaves, 0.0, 15.0);
    return octaves >= 1.0 ? octaves - 1.0 : keeps_part ? octaves : 0.0;
}

// The share of the only octave, if there is less than one, over what there is without any.
float musgrave_value(float value, float without, float octaves)
{
    return finite(mix(without, value, clamp(octaves, 0.0, 1.0)));
}
