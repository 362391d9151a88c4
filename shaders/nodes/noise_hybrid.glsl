// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: hybrid multifractal noise [Musgrave89]: octaves weigh as much as those before them have left.

#include "nodes/noise.glsl"

float noise_hybrid(int n, vec4 p, float detail, float roughness, float lacunarity, float offset, float gain)
{
    float value = 0.0, amplitude = 1.0, weight = 1.0;
    detail = noise_detail(detail);
    roughness = max(roughness, 0.0);
    for (float i = 0.0; i < detail + 1.0 && weight > 0.001; i++) {
        weight = min(weight, 1.0);
        float octave = (noise_signed(p, n) + offset) * amplitude;
        value += min(detail + 1.0 - i, 1.0) * weight * octave;
        weight *= gain * octave;
        amplitude *= roughness;
        p *= lacunarity;
    }
    return finite(value);
}

vec3 noise_hybrid_color(int n, vec4 p, float detail, float roughness, float lacunarity, float offset, float gain)
{
    vec3 color = vec3(0.0);
    for (int i = 0, end = turns(3, p); i < end; i++)
        color[i] = noise_hybrid(n, noise_channel(p, n, i), detail, roughness, lacunarity, offset, gain);
    return color;
}
