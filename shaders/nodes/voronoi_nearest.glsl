// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: cellular textures of the nearest point, the second nearest, and a smooth minimum over all points around:
//          their distance, place, and a colour of their cell, in octaves.

#include "nodes/voronoi.glsl"

const int NEAREST = 0;
const int NEAREST_SECOND = 1;
const int NEAREST_SMOOTH = 2;

struct Voronoi {
    float distance;
    vec3 color;
    vec3 position;  // in the space that is looked up
    float w;
};

// Of one octave, or a sum of them.
struct CellsSeen {
    float distance;
    vec3 color;
    vec4 place;
};

// The nearest point, or the second nearest, of the cells next to p's.
CellsSeen nearest_cell(Cells c, vec4 p, bool second)
{
    vec4 corner = floor(p), f = p - corner;
    ivec4 cell = ivec4(corner), around = first_cell(c.n, 1), best = ivec4(0), runner_up = ivec4(0);
    float least = BEYOND, less = BEYOND;
    for (int i = 0, end = n_cells(c.n, 1, p); i < end; i++) {
        float d = cell_measure(c, vec4(around) + cell_point(c, cell + around) - f);
        d = second ? cell_length(c, d) : d;
        if (d < least) {
            less = least;
            runner_up = best;
            least = d;
            best = around;
        } else if (d < less) {
            less = d;
            runner_up = around;
        }
        around = next_cell(around, c.n, 1);
    }
    best = second ? runner_up : best;
    float d = second ? finite(less) : cell_length(c, finite(least));
    // In this order, as Cycles: white noise of a place is another one if a last bit is
    return CellsSeen(d, cell_color(c.n, cell + best), (vec4(best) + cell_point(c, cell + best)) + corner);
}

// A smooth minimum over the cells in order. smoothness: half of what is at most blended, above 0.
CellsSeen smooth_cell(Cells c, vec4 p, float smoothness, int reach)
{
    vec4 corner = floor(p), f = p - corner;
    ivec4 cell = ivec4(corner), around = first_cell(c.n, reach);
    CellsSeen s = CellsSeen(0.0, vec3(0.0), vec4(0.0));
    for (int i = 0, end = n_cells(c.n, reach, p); i < end; i++) {
        vec4 point = vec4(around) + cell_point(c, cell + around);
        float d = cell_length(c, cell_measure(c, point - f));
        float h = i == 0 ? 1.0 : smoothstep(0.0, 1.0, 0.5 + 0.5 * (s.distance - d) / smoothness);
        float lowered = smoothness * h * (1.0 - h);
        s.distance = mix(s.distance, d, h) - lowered;
        lowered /= 1.0 + 3.0 * smoothness;
        s.color = mix(s.color, cell_color(c.n, cell + around), h) - lowered;
        s.place = mix(s.place, point, h) - lowered;
        around = next_cell(around, c.n, reach);
    }
    s.place = (s.place + corner) * vec4(lessThan(ivec4(0, 1, 2, 3), ivec4(c.n)));
    return s;
}

// feature: one of NEAREST...
Voronoi voronoi_nearest(int n, int metric, int feature, bool normalizes, vec4 p, float scale, float detail, float roughness, float lacunarity, float smoothness, float exponent, float randomness)
{
    Cells c = cells_of(n, metric, exponent, randomness);
    CellsSeen sum = CellsSeen(0.0, vec3(0.0), vec4(0.0));
    float amplitude = 1.0, whole = 0.0, octave_scale = 1.0;
    detail = clamp(detail, 0.0, 15.0);
    roughness = clamp(roughness, 0.0, 1.0);
    smoothness = clamp(smoothness / 2.0, 0.0, 0.5);
    if (roughness == 0.0)
        detail = 0.0;
    for (float i = 0.0; i < detail + 1.0; i++) {
        CellsSeen s;
        if (feature == NEAREST_SMOOTH)
            s = smooth_cell(c, p * octave_scale, max(smoothness, 1e-9), smoothness > 0.0 ? 2 : 1);
        else
            s = nearest_cell(c, p * octave_scale, feature == NEAREST_SECOND);
        float share = min(detail + 1.0 - i, 1.0);
        whole += share * amplitude;
        sum.distance += share * amplitude * s.distance;
        sum.color += share * amplitude * s.color;
        sum.place = mix(sum.place, s.place / octave_scale, share * amplitude);
        octave_scale *= lacunarity;
        amplitude *= roughness;
    }
    if (normalizes) {
        sum.distance /= whole * cell_reach(c) * (feature == NEAREST_SECOND ? 2.0 : 1.0);
        sum.color /= whole;
    }
    vec4 place = scale != 0.0 ? sum.place * (1.0 / scale) : vec4(0.0);
    place = n == 1 ? place.yzwx : place;
    return Voronoi(finite(sum.distance), finite_3(sum.color), finite_3(place.xyz), finite(place.w));
}
