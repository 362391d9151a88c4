// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what surfels look like.

uniform usamplerBuffer u_surfel_colors;  // of SurfelColors, 16 bytes a texel

vec3 albedo_of_surfel(uint surfel)
{
    return uintBitsToFloat(texelFetch(u_surfel_colors, int(2u * surfel)).rgb);
}

// Albedo, and the share of it that sends light on to the other side.
vec4 look_of_surfel(uint surfel)
{
    return uintBitsToFloat(texelFetch(u_surfel_colors, int(2u * surfel)));
}

// Radiance.
vec3 emission_of_surfel(uint surfel)
{
    return uintBitsToFloat(texelFetch(u_surfel_colors, int(2u * surfel + 1u)).rgb);
}
