// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the world's light drawn where its image is bright: a row, then a column in it, by tables of cumulative
// probabilities.

#include "bind/environment.glsl"
#include "bind/draws.glsl"

uniform usamplerBuffer u_sky;    // rows of numbers, four a texel: the cumulative probability of the row, then of its columns
uniform ivec2 u_sky_size;        // columns, rows
uniform mat3 u_world_from_env;

float sky_entry(int row, int column)
{
    int i = row * (u_sky_size.x + 1) + column;
    return uintBitsToFloat(texelFetch(u_sky, i >> 2)[i & 3]);
}

// The first entry above u of n that ascend: of column 0 if row < 0, else of a row. u becomes its place between that and the
// one before, share their difference.
int find_entry(int row, int n, inout float u, out float share)
{
    int low = 0, high = n - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if ((row < 0 ? sky_entry(middle, 0) : sky_entry(row, middle + 1)) > u)
            high = middle;
        else
            low = middle + 1;
    }
    float after = row < 0 ? sky_entry(low, 0) : sky_entry(row, low + 1);
    float before = low == 0 ? 0.0 : row < 0 ? sky_entry(low - 1, 0) : sky_entry(row, low);
    share = after - before;
    u = share > 0.0 ? clamp((u - before) / share, 0.0, 1.0) : 0.5;
    return low;
}

// Density [sr^-1] of unit d, whose direction in the image's space before it was made a unit vector is e.
float sky_density(float share, vec3 e)
{
    float length_e = length(e), cos_latitude = max(length(e.xy) / length_e, 1e-6);
    float per_image = share * float(u_sky_size.x * u_sky_size.y) / (2.0 * PI * PI * cos_latitude);
    return per_image * abs(determinant(u_env_from_world)) / (length_e * length_e * length_e);
}

LightDraw draw_sky(vec2 u)
{
    float row_share, column_share;
    int row = find_entry(-1, u_sky_size.y, u.y, row_share), column = find_entry(row, u_sky_size.x, u.x, column_share);
    vec2 uv = (vec2(column, row) + u) / vec2(u_sky_size);
    float azimuth = (0.5 - uv.x) * 2.0 * PI, latitude = (uv.y - 0.5) * PI;
    vec3 d = normalize(u_world_from_env * vec3(cos(latitude) * vec2(cos(azimuth), sin(azimuth)), sin(latitude)));
    float density = sky_density(row_share * column_share, u_env_from_world * d);
    return density > 0.0 ? LightDraw(d, INFINITE, world_radiance(d, 0.0) / density, density) : NO_DRAW;
}

// [sr^-1] with which draw_sky finds unit d.
float world_density(vec3 d)
{
    vec3 e = u_env_from_world * d;
    ivec2 at = clamp(ivec2(image_uv(e) * vec2(u_sky_size)), ivec2(0), u_sky_size - 1);
    float row = sky_entry(at.y, 0) - (at.y > 0 ? sky_entry(at.y - 1, 0) : 0.0);
    float column = sky_entry(at.y, at.x + 1) - (at.x > 0 ? sky_entry(at.y, at.x) : 0.0);
    return sky_density(row * column, e);
}

// Share of the world that a ray along d finds, drawn with pdf_ray [sr^-1]: draws find it too.
float world_weight(vec3 d, float pdf_ray)
{
    return u_n_sky_draws > 0 ? balance(pdf_ray, world_density(d)) : 1.0;
}
