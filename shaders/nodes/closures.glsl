// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a tree gives: the closures of a point.

#include "bind/geo.glsl"

struct Closures {
    vec3 diffuse;
    vec3 normal;
    vec3 emission;
    vec3 transparency;
    bool wants_mean;
    float chance;
};

Closures no_closures(Geo g, float chance, bool wants_mean)
{
    return Closures(vec3(0.0), g.normal, vec3(0.0), vec3(0.0), wants_mean, chance);
}

void closure_diffuse(inout Closures c, float weight, vec3 color, float roughness, vec3 normal)
{
    c.diffuse += weight * max(color, 0.0);
    c.normal = normal;
}

void closure_emission(inout Closures c, float weight, vec3 color, float strength)
{
    c.emission += weight * strength * color;
}

void closure_transparent(inout Closures c, float weight, vec3 color)
{
    c.transparency += weight * color;
}
