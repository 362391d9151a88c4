// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what trees of nodes look like to all programs that do not evaluate them: each triangle is cut into cells along its
// barycentrics, k along an edge and so k^2 in all, each of one colour.

#include "bind/instances.glsl"

uniform usamplerBuffer u_baked;  // rows of all triangles as placed, two a texel: first cell, k; then a texel a cell
uniform uint u_n_rows;           // texels of rows; 0 if nothing is baked

const uint NOT_BAKED = 0xffffffffu;

struct Cell {
    vec3 albedo;
    float opacity;
    vec3 emission;  // radiance
    float through;  // share of the albedo that sends light on to the other side
};

// The number of a cell in its triangle. Rows go along the second barycentric, cells of a row point up and down in turns.
uint cell_of(vec2 bary, uint k)
{
    vec2 at = clamp(bary, 0.0, 1.0) * float(k);
    uvec2 i = min(uvec2(at), uvec2(k - 1u));
    i.x = min(i.x, k - 1u - i.y);
    bool is_down = i.x + i.y + 1u < k && dot(at - vec2(i), vec2(1.0)) > 1.0;
    return i.y * (2u * k - i.y) + 2u * i.x + uint(is_down);
}

// Its middle.
vec2 bary_of_cell(uint cell, uint k)
{
    uint row = k - uint(ceil(sqrt(float(k * k - cell))));
    row -= uint(row > 0u && row * (2u * k - row) > cell);
    row += uint((row + 1u) * (2u * k - row - 1u) <= cell);
    uint along = cell - row * (2u * k - row);
    float third = (along & 1u) == 0u ? 1.0 / 3.0 : 2.0 / 3.0;
    return (vec2(along >> 1u, row) + third) / float(k);
}

// The texel of the cell at a point; NOT_BAKED where the table of materials says all.
uint baked_at(uint instance, uint triangle, vec2 bary)
{
    if (u_n_rows == 0u)
        return NOT_BAKED;
    uint work = instances[instance].first_work + triangle - instances[instance].first_triangle;
    uvec4 rows = texelFetch(u_baked, int(work >> 1u));
    uvec2 row = (work & 1u) == 0u ? rows.xy : rows.zw;
    return row.y == 0u ? NOT_BAKED : u_n_rows + row.x + cell_of(bary, row.y);
}

// Albedos by their roots in 11, 11 and 10 bits, radiance with one exponent of 10 bits for all of it, shares in 6.
uvec4 packed_cell(Cell c)
{
    uvec3 root = uvec3(round(sqrt(clamp(c.albedo, 0.0, 1.0)) * vec3(2047.0, 2047.0, 1023.0)));
    float most = max(c.emission.r, max(c.emission.g, c.emission.b));
    int exponent = 0;
    frexp(most, exponent);
    uvec3 rgb = most > 0.0 ? uvec3(round(clamp(ldexp(max(c.emission, 0.0), ivec3(-exponent)), 0.0, 1.0) * 65535.0)) : uvec3(0u);
    return uvec4(root.r | root.g << 11 | root.b << 22, floatBitsToUint(clamp(c.opacity, 0.0, 1.0)), rgb.r | rgb.g << 16,
                 rgb.b | uint(exponent + 512) << 16 | uint(round(63.0 * clamp(c.through, 0.0, 1.0))) << 26);
}

Cell unpacked_cell(uvec4 t)
{
    vec3 root = vec3(t.x & 2047u, t.x >> 11u & 2047u, t.x >> 22u) / vec3(2047.0, 2047.0, 1023.0);
    vec3 rgb = vec3(t.z & 65535u, t.z >> 16u, t.w & 65535u) / 65535.0;
    return Cell(root * root, uintBitsToFloat(t.y), ldexp(rgb, ivec3(int(t.w >> 16u & 1023u) - 512)), float(t.w >> 26u) / 63.0);
}
