// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: multifractal noise [Musgrave89]: a product of octaves around 1.

#include "nodes/noise.glsl"

float noise_multifractal(int n, vec4 p, float detail, float roughness, float lacunarity)
{
    float value = 1.0, amplitude = 1.0;
    detail = noise_detail(detail);
    roughness = max(roughness, 0.0);
    for (float i = 0.0; i < detail + 1.0; i++) {
        value *= min(detail + 1.0 - i, 1.0) * amplitude * noise_signed(p, n) + 1.0;
        amplitude *= roughness;
        p *= lacunarity;
    }
    return finite(value);
}

vec3 noise_multifractal_color(int n, vec4 p, float detail, float roughness, float lacunarity)
{
    vec3 color = vec3(0.0);
    for (int i = 0, end = turns(3, p); i < end; i++)
        color[i] = noise_multifractal(n, noise_channel(p, n, i), detail, roughness, lacunarity);
    return color;
}
