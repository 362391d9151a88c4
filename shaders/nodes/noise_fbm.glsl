// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: fractal Brownian motion [Musgrave89]: a sum of octaves, the last of which may be there in part.

#include "nodes/noise.glsl"

// detail: octaves after the first. In [0, 1] if it is normalized, else around 0.
float noise_fbm(int n, vec4 p, float detail, float roughness, float lacunarity, bool normalizes)
{
    float scale = 1.0, amplitude = 1.0, whole = 0.0, sum = 0.0, value = 0.0;
    detail = noise_detail(detail);
    roughness = max(roughness, 0.0);
    for (float i = 0.0; i < detail + 1.0; i++) {
        sum += noise_signed(scale * p, n) * amplitude;
        whole += amplitude;
        value = mix(value, normalizes ? 0.5 * sum / whole + 0.5 : sum, min(detail + 1.0 - i, 1.0));
        amplitude *= roughness;
        scale *= lacunarity;
    }
    return finite(value);
}

vec3 noise_fbm_color(int n, vec4 p, float detail, float roughness, float lacunarity, bool normalizes)
{
    vec3 color = vec3(0.0);
    for (int i = 0, end = turns(3, p); i < end; i++)
        color[i] = noise_fbm(n, noise_channel(p, n, i), detail, roughness, lacunarity, normalizes);
    return color;
}
