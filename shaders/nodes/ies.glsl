// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the IES Texture: strengths by two angles, between which the curve of Catmull and Rom goes.

#include "bind/geo.glsl"
#include "lib/math.glsl"

float ies_without_file(float strength, float value)
{
    return strength * value;
}

// A cubic through b and c, at f between them.
float ies_cubic(vec4 p, float f)
{
    float third = p.w + 3.0 * (p.y - p.z) - p.x, second = 2.0 * p.x - 5.0 * p.y + 4.0 * p.z - p.w;
    return p.y + 0.5 * f * (p.z - p.x + f * (second + f * third));
}

// The interval of n ascending angles from `first` on that x lies in, and where; -1 outside.
int ies_interval(Geo g, uint first, int n, float x, out float f)
{
    f = 0.0;
    if (x < value_at(g, first) || x >= value_at(g, first + uint(n - 1)))
        return -1;
    int low = 0, high = n - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (value_at(g, first + uint(middle)) < x)
            low = middle;
        else
            high = middle;
    }
    float a = value_at(g, first + uint(low)), b = value_at(g, first + uint(low + 1));
    f = b > a ? (x - a) / (b - a) : 0.0;
    return low;
}

// Between the strengths of one column of n_down; beyond straight down and up it goes on as it came.
float ies_column(Geo g, uint first, int n_down, int v, float f, bvec2 has_poles)
{
    vec4 p = vec4(0.0);
    for (int i = 0; i < 4; i++) {
        int at = v - 1 + i;
        if (at < 0)
            at = has_poles.x ? 1 : -1;
        else if (at >= n_down)
            at = has_poles.y ? n_down - 2 : -1;
        p[i] = at < 0 ? 0.0 : value_at(g, first + uint(at));
    }
    return ies_cubic(p, f);
}

// numbers: n_across angles around the lamp, n_down ones from straight down, and the strengths of each column.
float ies_strength(Geo g, vec3 direction, float strength, uint numbers, float n_across, float n_down)
{
    int columns = int(n_across), rows = int(n_down);
    uint downs = numbers + uint(columns), strengths = downs + uint(rows);
    float size = length(direction);
    vec3 d = size > 0.0 ? direction / size : vec3(0.0);
    float across = (d.x != 0.0 || d.y != 0.0 ? atan(d.x, d.y) : 0.0) + PI, f, fv;
    int h = ies_interval(g, numbers, columns, across, f), v = ies_interval(g, downs, rows, acos(clamp(-d.z, -1.0, 1.0)), fv);
    if (h < 0 || v < 0)
        return 0.0;
    bvec2 has_poles = bvec2(value_at(g, downs) < 1e-7, value_at(g, downs + uint(rows - 1)) > PI - 1e-6);
    vec4 p = vec4(0.0);
    for (int i = 0; i < 4; i++) {
        int at = h - 1 + i;
        at = at < 0 ? columns - 2 : at >= columns ? 1 : at;
        p[i] = ies_column(g, strengths + uint(at * rows), rows, v, fv, has_poles);
    }
    return strength * max(ies_cubic(p, f), 0.0);
}
