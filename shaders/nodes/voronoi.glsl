// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: cellular textures [Worley96] as Cycles has them: a point in each cell of a grid in 1 to 4 dimensions, and the
//          distances to it. The number of dimensions n and the metric are constants wherever these are called.

#include "nodes/hash.glsl"
#include "nodes/texture_space.glsl"

const int METRIC_EUCLIDEAN = 0;
const int METRIC_MANHATTAN = 1;
const int METRIC_CHEBYCHEV = 2;
const int METRIC_MINKOWSKI = 3;

const float BEYOND = 1e37;  // longer than any distance

// What an octave of the texture is made with. All within their ranges.
struct Cells {
    int n;
    int metric;
    float exponent;    // of Minkowski's metric
    float randomness;  // how far points lie from their cells' corners
};

Cells cells_of(int n, int metric, float exponent, float randomness)
{
    return Cells(n, metric, exponent, clamp(randomness, 0.0, 1.0));
}

// Where in its cell, from its corner, the point of a cell lies.
vec4 cell_point(Cells c, ivec4 cell)
{
    vec4 random = c.n == 1 ? vec4(hash_of(vec4(cell), 1), 0.0, 0.0, 0.0) :
                  c.n == 2 ? vec4(hash_of_cell_2(cell.xy), 0.0, 0.0) :
                  c.n == 3 ? vec4(hash_of_cell_3(cell.xyz), 0.0) : hash_of_cell_4(cell);
    return random * c.randomness;
}

vec3 cell_color(int n, ivec4 cell)
{
    if (n == 1) {
        float x = float(cell.x);
        return vec3(hash_of(vec4(x), 1), hash_of_2(x, 1.0), hash_of_2(x, 2.0));
    }
    if (n == 4)
        return hash_of_cell_4(cell).xyz;
    return hash_of_cell_3(n == 2 ? ivec3(cell.xy, 0) : cell.xyz);
}

float sum_of(vec4 v, int n)
{
    return v.x + (n > 1 ? v.y : 0.0) + (n > 2 ? v.z : 0.0) + (n > 3 ? v.w : 0.0);
}

// A power of a number that is not negative. Exponents are not either, in Blender.
float cell_power(float x, float exponent)
{
    return x > 0.0 ? pow(x, exponent) : exponent == 0.0 ? 1.0 : 0.0;
}

// What tells which of two vectors is longer. The length itself is `cell_length` of it.
float cell_measure(Cells c, vec4 v)
{
    v = abs(v);
    if (c.n == 1)
        return v.x;
    if (c.metric == METRIC_EUCLIDEAN)
        return sum_of(v * v, c.n);
    if (c.metric == METRIC_MANHATTAN)
        return sum_of(v, c.n);
    if (c.metric == METRIC_CHEBYCHEV)
        return max(max(v.x, v.y), max(c.n > 2 ? v.z : 0.0, c.n > 3 ? v.w : 0.0));
    vec4 powers = vec4(cell_power(v.x, c.exponent), cell_power(v.y, c.exponent),
                       c.n > 2 ? cell_power(v.z, c.exponent) : 0.0, c.n > 3 ? cell_power(v.w, c.exponent) : 0.0);
    return sum_of(powers, c.n);
}

float cell_length(Cells c, float measure)
{
    if (c.n == 1 || c.metric == METRIC_MANHATTAN || c.metric == METRIC_CHEBYCHEV)
        return measure;
    return c.metric == METRIC_EUCLIDEAN ? sqrt(measure) : cell_power(measure, 1.0 / c.exponent);
}

// Half the longest way between the points of neighbours.
float cell_reach(Cells c)
{
    return cell_length(c, cell_measure(c, vec4(0.5 + 0.5 * c.randomness)));
}

// Cells around one, in rows: the first is reach before it along each axis.
ivec4 first_cell(int n, int reach)
{
    return -reach * ivec4(lessThan(ivec4(0, 1, 2, 3), ivec4(n)));
}

// The one after `cell`.
ivec4 next_cell(ivec4 cell, int n, int reach)
{
    cell.x++;
    if (n > 1 && cell.x > reach) {
        cell.x = -reach;
        cell.y++;
        if (n > 2 && cell.y > reach) {
            cell.y = -reach;
            cell.z++;
            if (n > 3 && cell.z > reach) {
                cell.z = -reach;
                cell.w++;
            }
        }
    }
    return cell;
}

// How many there are. Compilers do not know, so that they do not write them out.
int n_cells(int n, int reach, vec4 p)
{
    int width = 2 * reach + 1, row = width * width;
    return turns(n == 1 ? width : n == 2 ? row : n == 3 ? row * width : row * row, p);
}
