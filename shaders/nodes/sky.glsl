// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Sky Texture's models, from what the host has computed of them (svo_engine/nodes/skies).

#include "bind/geo.glsl"
#include "lib/math.glsl"

const uint SKY_WIDE = 256u;         // columns of a table: half a turn, the other half is its mirror image
const float SKY_LOWEST = 0.5 * PI - 0.001;  // zenith angle from which the daylight models go on unchanged

// Rec. 709 of CIE XYZ, without negative colours.
vec3 sky_rgb(vec3 c)
{
    return max(vec3(dot(c, vec3(3.2409699, -1.5373832, -0.4986108)), dot(c, vec3(-0.9692436, 1.8759675, 0.0415551)),
                    dot(c, vec3(0.0556301, -0.2039770, 1.0569715))), 0.0);
}

vec3 sky_texel(Geo g, uint table, uint rows, int x, int y)
{
    uint column = uint(clamp(x, 0, 2 * int(SKY_WIDE) - 1)), row = uint(clamp(y, 0, int(rows) - 1));
    column = column < SKY_WIDE ? column : 2u * SKY_WIDE - 1u - column;
    return value3_at(g, table + 3u * (row * SKY_WIDE + column));
}

// The table at shares `at` of its whole width and height, interpolated.
vec3 sky_interpolated(Geo g, uint table, uint rows, vec2 at)
{
    vec2 p = at * vec2(2u * SKY_WIDE, rows) - 0.5, low = floor(p), f = p - low;
    int x = int(low.x), y = int(low.y);
    vec3 below = mix(sky_texel(g, table, rows, x, y), sky_texel(g, table, rows, x + 1, y), f.x);
    vec3 above = mix(sky_texel(g, table, rows, x, y + 1), sky_texel(g, table, rows, x + 1, y + 1), f.x);
    return sky_rgb(mix(below, above, f.y));
}

float sky_elevation(vec3 d)
{
    return 0.5 * PI - acos(clamp(d.z, -1.0, 1.0));
}

float sky_column(vec3 d, float rotation)
{
    return fract((-(d.x != 0.0 || d.y != 0.0 ? atan(d.y, d.x) : 0.0) - 0.5 * PI - rotation) / (2.0 * PI));
}

// Blender 5: single or multiple scattering.
vec3 sky_scattering(Geo g, vec3 direction, uint table, float rotation)
{
    float elevation = sky_elevation(direction), row = 0.5 * sign(elevation) * sqrt(abs(elevation) / (0.5 * PI)) + 0.5;
    return sky_interpolated(g, table, 256u, vec2(sky_column(direction, rotation), row));
}

// Blender 4: single scattering, over a ground that fades to black.
vec3 sky_nishita(Geo g, vec3 direction, uint table, float rotation)
{
    float fade = direction.z < 0.0 ? max(1.0 + 2.5 * direction.z, 0.0) : 1.0;
    float row = direction.z < 0.0 ? -0.5 : sqrt(max(sky_elevation(direction), 0.0) / (0.5 * PI));
    return fade * fade * fade * sky_interpolated(g, table, 128u, vec2(sky_column(direction, rotation), row));
}

// The sky with its sun's disc, where that is asked for: for its own light, it is a lamp and in no image. disc: unit vector to
// the sun, angular radius, CIE XYZ of its lowest and highest point, elevation below which it is hidden.
vec3 sky_disc(Geo g, vec3 direction, vec3 sky, uint disc)
{
    vec3 sun = value3_at(g, disc);
    float radius = value_at(g, disc + 3u), elevation = sky_elevation(direction);
    float angle = 2.0 * atan(length(direction - sun), length(direction + sun));
    if ((g.rays & RAY_DISC) == 0u || angle >= radius || elevation <= value_at(g, disc + 10u))
        return sky;
    float height = 0.5 * (elevation - sky_elevation(sun)) / radius + 0.5, r = angle / radius;
    vec3 xyz = mix(value3_at(g, disc + 4u), value3_at(g, disc + 7u), height);
    return sky + sky_rgb(xyz) * (1.0 - 0.6 * (1.0 - sqrt(1.0 - r * r)));
}

// Cosine of the zenith angle (x), angle to the sun (y) and its cosine (z), for the daylight models. parameters: first a unit
// vector to the sun.
vec3 sky_angles(Geo g, vec3 direction, uint parameters)
{
    float theta = acos(clamp(direction.z, -1.0, 1.0));
    vec3 sun = value3_at(g, parameters);
    vec2 across = direction.x != 0.0 || direction.y != 0.0 ? normalize(direction.xy) : vec2(1.0, 0.0);
    float cosine = clamp(dot(vec3(sin(theta) * across, cos(theta)), sun), -1.0, 1.0);
    return vec3(cos(min(theta, SKY_LOWEST)), acos(cosine), cosine);
}

float sky_perez(Geo g, vec3 angles, uint p)
{
    float sun = value_at(g, p + 3u) * exp(value_at(g, p + 4u) * angles.y) + value_at(g, p + 5u) * angles.z * angles.z;
    return value_at(g, p) * (1.0 + value_at(g, p + 1u) * exp(value_at(g, p + 2u) / angles.x)) * (1.0 + sun);
}

vec3 sky_preetham(Geo g, vec3 direction, uint parameters)
{
    vec3 angles = sky_angles(g, direction, parameters);
    float Y = sky_perez(g, angles, parameters + 3u), x = sky_perez(g, angles, parameters + 9u);
    float y = sky_perez(g, angles, parameters + 15u), scale = y != 0.0 ? Y / y : 0.0;
    return sky_rgb(vec3(scale * x, Y, scale * (1.0 - x - y)));
}
