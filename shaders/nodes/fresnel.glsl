// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: Fresnel and Layer Weight.

#include "bind/geo.glsl"

// Unpolarised reflectance of a smooth dielectric of relative index eta.
float dielectric_reflectance(float cos_theta, float eta)
{
    float c = min(abs(cos_theta), 1e6), g2 = eta * eta - 1.0 + c * c;
    if (g2 <= 0.0)
        return 1.0;
    float g = sqrt(g2), a = (g - c) / (g + c), b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

float fresnel(Geo g, float ior, vec3 normal)
{
    float eta = clamp(ior, 1e-5, 1e6);
    return dielectric_reflectance(dot(g.wo, normal), g.is_back ? 1.0 / eta : eta);
}

float layer_fresnel(Geo g, float blend, vec3 normal)
{
    float eta = clamp(1.0 - blend, 1e-5, 1e6);
    return dielectric_reflectance(dot(g.wo, normal), g.is_back ? eta : 1.0 / eta);
}

float layer_facing(Geo g, float blend, vec3 normal)
{
    float f = min(abs(dot(g.wo, normal)), 1e18);
    if (blend != 0.5) {
        float b = clamp(blend, 0.0, 1.0 - 1e-5);
        f = min(pow(f, b < 0.5 ? 2.0 * b : 0.5 / (1.0 - b)), 1e18);
    }
    return 1.0 - f;
}
