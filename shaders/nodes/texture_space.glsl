// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the point at which a texture of 1 to 4 dimensions is looked up, and what keeps textures finite.

const float TEXTURE_LIMIT = 1e30;  // numbers beyond it, and what is no number, are taken as 0

float finite(float x)
{
    return abs(x) < TEXTURE_LIMIT ? x : 0.0;
}

vec3 finite_3(vec3 v)
{
    return vec3(finite(v.x), finite(v.y), finite(v.z));
}

// n coordinates, and 0 for the rest: one dimension is that of w.
vec4 texture_point(int n, vec3 at, float w, float scale)
{
    vec4 p = n == 1 ? vec4(w, 0.0, 0.0, 0.0) : n == 2 ? vec4(at.xy, 0.0, 0.0) : n == 3 ? vec4(at, 0.0) : vec4(at, w);
    return p * scale;
}

// A loop's end that compilers do not know, so that they do not write its turns out: n for all points that are any.
int turns(int n, vec4 p)
{
    return abs(p.x) < TEXTURE_LIMIT ? n : 0;
}

// A node's own mapping: rows of its matrix, and what it moves by.
vec3 texture_mapped(vec3 p, vec3 row_x, vec3 row_y, vec3 row_z, vec3 moved)
{
    return vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p)) + moved;
}

// The same for normals.
vec3 texture_mapped_normal(vec3 p, vec3 row_x, vec3 row_y, vec3 row_z)
{
    vec3 v = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
    float l = length(v);
    return l > 0.0 ? v / l : vec3(0.0);
}
