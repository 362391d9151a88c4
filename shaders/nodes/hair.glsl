// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: colours of hair.

// Of much hair that absorbs so much of the light that crosses one: the inverse of the fit of [Chiang16].
vec3 hair_color(vec3 absorption, float radial_roughness)
{
    float x = radial_roughness;
    float scale = 5.969 + x * (-0.215 + x * (2.532 + x * (-10.73 + x * (5.574 + 0.245 * x))));
    return exp(-sqrt(max(absorption, 0.0)) * scale);
}

vec3 hair_absorption(vec3 color, float radial_roughness)
{
    float x = radial_roughness;
    float scale = 5.969 + x * (-0.215 + x * (2.532 + x * (-10.73 + x * (5.574 + 0.245 * x))));
    vec3 s = log(max(color, 1e-5)) / scale;
    return s * s;
}

// Of hair with pigments: melanin from 0 to 1, of which redness is pheomelanin.
vec3 melanin_color(float melanin, float redness, vec3 tint, float radial_roughness)
{
    float amount = -log(max(1.0 - melanin, 1e-4));
    vec3 absorption = amount * mix(vec3(0.506, 0.841, 1.653), vec3(0.343, 0.733, 1.924), clamp(redness, 0.0, 1.0));
    return hair_color(absorption + hair_absorption(tint, radial_roughness), radial_roughness);
}
