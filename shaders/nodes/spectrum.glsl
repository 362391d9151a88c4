// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: colours of wavelengths and of glowing bodies, from tables of the host.

#include "bind/geo.glsl"

const float SPECTRUM_FIRST = 380.0, SPECTRUM_STEP = 5.0;  // nm
const uint SPECTRUM_SIZE = 81u;
const float BLACKBODY_FIRST = 800.0, BLACKBODY_LAST = 12000.0;  // K
const uint BLACKBODY_SIZE = 256u;

// Black outside of what is seen.
vec3 wavelength_color(Geo g, uint table, float wavelength)
{
    float x = (wavelength - SPECTRUM_FIRST) / SPECTRUM_STEP;
    if (x <= -1.0 || x >= float(SPECTRUM_SIZE - 1u))
        return vec3(0.0);
    uint i = uint(max(x, 0.0));
    return max(mix(value3_at(g, table + 3u * i), value3_at(g, table + 3u * i + 3u), x - float(i)), 0.0);
}

// Of luminance 1. Entries are even in one over the temperature.
vec3 blackbody_color(Geo g, uint table, float temperature)
{
    float t = clamp(temperature, BLACKBODY_FIRST, BLACKBODY_LAST);
    float x = (1.0 / BLACKBODY_FIRST - 1.0 / t) / (1.0 / BLACKBODY_FIRST - 1.0 / BLACKBODY_LAST) * float(BLACKBODY_SIZE - 1u);
    uint i = min(uint(max(x, 0.0)), BLACKBODY_SIZE - 2u);
    return max(mix(value3_at(g, table + 3u * i), value3_at(g, table + 3u * i + 3u), x - float(i)), 0.0);
}
