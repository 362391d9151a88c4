// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: cellular textures of the distance to the edge between two cells, in octaves, and of the spheres that fit between
//          a point and the one next to it.

#include "nodes/voronoi.glsl"

// From p to the middle between its point and the one on either side.
float edge_in_a_row(Cells c, vec4 p)
{
    int cell = int(floor(p.x));
    float f = p.x - floor(p.x), here = cell_point(c, ivec4(cell)).x;
    float before = cell_point(c, ivec4(cell - 1)).x - 1.0, after = cell_point(c, ivec4(cell + 1)).x + 1.0;
    return min(abs(0.5 * (here + before) - f), abs(0.5 * (here + after) - f));
}

// From p to the nearest plane between the point nearest to it and another one.
float edge_of_cell(Cells c, vec4 p)
{
    vec4 f = p - floor(p), nearest = vec4(0.0);
    ivec4 cell = ivec4(floor(p)), first = first_cell(c.n, 1), around = first;
    float least = BEYOND, edge = BEYOND;
    // Once around for the nearest point, and once more for the planes
    int n = n_cells(c.n, 1, p);
    for (int i = 0, end = 2 * n; i < end; i++) {
        around = i == n ? first : around;
        vec4 v = vec4(around) + cell_point(c, cell + around) - f, way = v - nearest;
        float d = dot(v, v), apart = dot(way, way);
        if (i < n && d < least) {
            least = d;
            nearest = v;
        }
        if (i >= n && apart > 0.0001)
            edge = min(edge, dot(0.5 * (nearest + v), way) / sqrt(apart));
        around = next_cell(around, c.n, 1);
    }
    return finite(edge);
}

float voronoi_edge(int n, bool normalizes, vec4 p, float detail, float roughness, float lacunarity, float randomness)
{
    Cells c = cells_of(n, METRIC_EUCLIDEAN, 1.0, randomness);
    float longest = 0.5 + 0.5 * c.randomness, whole = longest, amplitude = 1.0, scale = 1.0, edge = 8.0;
    detail = clamp(detail, 0.0, 15.0);
    roughness = clamp(roughness, 0.0, 1.0);
    if (roughness == 0.0)
        detail = 0.0;
    for (float i = 0.0; i < detail + 1.0; i++) {
        float d = n == 1 ? edge_in_a_row(c, p * scale) : edge_of_cell(c, p * scale);
        float share = amplitude * min(detail + 1.0 - i, 1.0);
        edge = mix(edge, min(edge, d / scale), share);
        whole = mix(whole, longest / scale, share);
        scale *= lacunarity;
        amplitude *= roughness;
    }
    return finite(normalizes ? edge / whole : edge);
}

// Half of the way from the point nearest to p to the point nearest to that.
float voronoi_radius(int n, vec4 p, float randomness)
{
    Cells c = cells_of(n, METRIC_EUCLIDEAN, 1.0, randomness);
    ivec4 cell = ivec4(floor(p)), first = first_cell(n, 1), around = first, best = ivec4(0);
    vec4 centre = p - floor(p), nearest = centre;
    float least = BEYOND;
    // Once around p, and once more around the point that was found
    int end = n_cells(n, 1, p);
    for (int i = 0; i < 2 * end; i++) {
        if (i == end) {
            cell += best;
            centre = nearest - vec4(best);
            around = first;
            least = BEYOND;
        }
        vec4 point = vec4(around) + cell_point(c, cell + around), v = point - centre;
        float d = sum_of(v * v, n);
        if (d < least && (i < end || around != ivec4(0))) {
            least = d;
            best = around;
            nearest = point;
        }
        around = next_cell(around, n, 1);
    }
    return 0.5 * sqrt(finite(least));
}
