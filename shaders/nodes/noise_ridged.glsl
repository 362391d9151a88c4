// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: ridged multifractal noise [Musgrave89]: octaves of crests, which weigh where those before them have one.
//          There are whole octaves alone.

#include "nodes/noise.glsl"

float noise_ridged(int n, vec4 p, float detail, float roughness, float lacunarity, float offset, float gain)
{
    float value = 0.0, amplitude = 1.0, weight = 1.0;
    detail = noise_detail(detail);
    roughness = max(roughness, 0.0);
    for (float i = 0.0; i <= detail; i++) {
        float crest = offset - abs(noise_signed(p, n));
        crest *= crest * weight;
        value += crest * amplitude;
        weight = clamp(crest * gain, 0.0, 1.0);
        amplitude *= roughness;
        p *= lacunarity;
    }
    return finite(value);
}

vec3 noise_ridged_color(int n, vec4 p, float detail, float roughness, float lacunarity, float offset, float gain)
{
    vec3 color = vec3(0.0);
    for (int i = 0, end = turns(3, p); i < end; i++)
        color[i] = noise_ridged(n, noise_channel(p, n, i), detail, roughness, lacunarity, offset, gain);
    return color;
}
