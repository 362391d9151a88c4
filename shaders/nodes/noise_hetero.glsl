// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: heterogeneous terrain [Musgrave89]: octaves grow with the height below them.

#include "nodes/noise.glsl"

float noise_hetero(int n, vec4 p, float detail, float roughness, float lacunarity, float offset)
{
    float value = 1.0, amplitude = 1.0;
    detail = noise_detail(detail);
    roughness = max(roughness, 0.0);
    for (float i = 0.0; i < detail + 1.0; i++) {
        float octave = (noise_signed(p, n) + offset) * amplitude;
        value = i == 0.0 ? octave : value + min(detail + 1.0 - i, 1.0) * octave * value;
        amplitude *= roughness;
        p *= lacunarity;
    }
    return finite(value);
}

vec3 noise_hetero_color(int n, vec4 p, float detail, float roughness, float lacunarity, float offset)
{
    vec3 color = vec3(0.0);
    for (int i = 0, end = turns(3, p); i < end; i++)
        color[i] = noise_hetero(n, noise_channel(p, n, i), detail, roughness, lacunarity, offset);
    return color;
}
