// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what rays know of materials: which share of them each one stops. All else is for programs that trace nothing.

#include "bind/baked.glsl"
#include "bind/textures.glsl"

layout(std430) readonly buffer Opacities { Opacity opacities[]; };  // of each material
layout(std430) readonly buffer Cutouts { uint cutouts[]; };         // of each instance: 0 if it stops every ray

uniform bool u_sees_trees;  // whether what trees of nodes let through is decided when they are evaluated

// The row of the tile at uv, which becomes relative to that; any of them where there is none. Rows are dense here: the host
// has one for each tile up to the last.
uint tile_row(uint first, inout vec2 uv)
{
    ivec2 tile = ivec2(uv);
    uint i = uint(10 * tile.y + tile.x);
    uv -= vec2(tile);
    return first + min(i, pictures[first].n_tiles - 1u);
}

// The number that a texture gives, from one channel, where the host has made a picture of one if it had to. As little as can
// be is kept at hand: a program that traces pays for each number, and texture_value made a card gather in 1.4 times the time.
float share_at(int index, vec2 uv)
{
    vec3 uv1 = vec3(uv, 1.0);
    vec2 at = vec2(dot(textures[index].u_from_uv, uv1), dot(textures[index].v_from_uv, uv1));
    uint row = textures[index].share, extension = textures[index].extension;
    if (pictures[row].tile != 0)
        row = tile_row(row, at);
    ivec2 size = max(ivec2(pictures[row].width, pictures[row].height), 1);
    int channel = textures[index].share_channel, n = textures[index].closest != 0u ? 1 : 4;
    at = at * vec2(size) - (n == 1 ? 0.0 : 0.5);
    if (!all(lessThan(abs(at), vec2(2e9))))
        return 0.0;
    bool is_float = pictures[row].format == FORMAT_FLOAT;
    float sum = 0.0;
    for (int i = 0; i < n; i++) {
        ivec2 corner = ivec2(i & 1, i >> 1), p = ivec2(floor(at)) + corner;
        vec2 f = fract(at), w = n == 1 ? vec2(1.0) : mix(1.0 - f, f, vec2(corner));
        int x = extended(p.x, size.x, extension), y = extended(p.y, size.y, extension);
        if (x < 0 || y < 0)
            continue;
        uint k = uint(y * size.x + x), first = pictures[row].first_word;
        float v = is_float ? uintBitsToFloat(word(first + 4u * k + uint(channel)))
                           : float(word(first + k) >> (8 * channel) & 255u) / 255.0;
        sum += w.x * w.y * v;
    }
    if (pictures[row].format == FORMAT_SRGB8 && channel < 3)
        sum = sum <= 0.04045 ? sum / 12.92 : pow((sum + 0.055) / 1.055, 2.4);
    return sum;
}

float opacity_at(uint instance, uint triangle, vec2 bary)
{
    uint at = baked_at(instance, triangle, bary);
    if (at != NOT_BAKED)
        return u_sees_trees ? 1.0 : uintBitsToFloat(texelFetch(u_baked, int(at)).y);
    Opacity o = opacities[material_of(instance, triangle)];
    return o.alpha_texture >= 0 ? o.alpha * share_at(o.alpha_texture, uv_at(triangle, bary)) : o.alpha;
}
