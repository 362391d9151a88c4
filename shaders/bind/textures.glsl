// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: images and the functions that read them, filtered as Cycles has it: texels as they are stored, with RGB times alpha
//          and in sRGB's encoding, and only the sum is divided and decoded. Texels are words: exact repeat modes, any size.

#include "lib/layouts.glsl"

layout(std430) readonly buffer Textures { Texture textures[]; };
layout(std430) readonly buffer Pictures { Picture pictures[]; };
uniform usampler2DArray u_words;  // one an 8-bit texel, four a float texel

const vec4 MISSING = vec4(1.0, 0.0, 1.0, 1.0);  // magenta

uint word(uint i)
{
    return texelFetch(u_words, ivec3(i % WORDS_WIDTH, i / WORDS_WIDTH % WORDS_HEIGHT, i / (WORDS_WIDTH * WORDS_HEIGHT)), 0).x;
}

vec3 linear_of_srgb(vec3 c)
{
    return mix(pow((max(c, 0.0) + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

// The texel index that `i` means under the texture's extension; -1 for outside.
int extended(int i, int n, uint extension)
{
    if (extension == EXTENSION_REPEAT)
        return i - n * int(floor(float(i) / float(n)));
    if (extension == EXTENSION_EXTEND)
        return clamp(i, 0, n - 1);
    if (extension == EXTENSION_CLIP)
        return i >= 0 && i < n ? i : -1;
    int period = i - 2 * n * int(floor(float(i) / float(2 * n)));
    return period < n ? period : 2 * n - 1 - period;
}

// As it is stored.
vec4 texel(Picture p, ivec2 at, uint extension)
{
    int x = extended(at.x, p.width, extension), y = extended(at.y, p.height, extension);
    if (x < 0 || y < 0)
        return vec4(0.0);
    uint i = uint(y * p.width + x);
    if (p.format != FORMAT_FLOAT)
        return unpackUnorm4x8(word(p.first_word + i));
    uint w = p.first_word + 4u * i;
    return uintBitsToFloat(uvec4(word(w), word(w + 1u), word(w + 2u), word(w + 3u)));
}

// The row of the image, or of its tile at uv, which becomes relative to that; n_tiles 0 where there is none.
Picture picture_at(uint row, inout vec2 uv)
{
    Picture p = pictures[row];
    if (p.tile == 0)
        return p;
    ivec2 at = ivec2(uv);  // towards zero, as Cycles does
    int wanted = at.x >= 0 && at.y >= 0 && at.x < 10 ? 1001 + 10 * at.y + at.x : -1;
    for (uint i = 0u, n = p.n_tiles; i < n; i++) {
        p = pictures[row + i];
        if (p.tile == wanted) {
            uv -= vec2(at);
            return p;
        }
    }
    p.n_tiles = 0u;
    return p;
}

// What a filter's sum of texels means. divides: the material reads alpha as well.
vec4 meant(Picture p, vec4 c, bool divides)
{
    if (divides && p.is_associated != 0u && c.a != 1.0 && c.a != 0.0)
        c.rgb /= c.a;
    return p.format == FORMAT_SRGB8 ? vec4(linear_of_srgb(c.rgb), c.a) : c;
}

// RGBA of an image: its closest texel, or linear between four.
vec4 picture_color(uint row, vec2 uv, uint extension, bool closest, bool divides)
{
    Picture p = picture_at(row, uv);
    vec2 at = uv * vec2(p.width, p.height) - (closest ? 0.0 : 0.5);
    if (!all(lessThan(abs(at), vec2(2e9))))
        return vec4(0.0);
    if (p.n_tiles == 0u)
        return MISSING;
    vec2 f = fract(at);
    vec4 c = vec4(0.0);
    // A loop whose end compilers do not know: they would write out all four, at every place that reads an image
    for (int i = 0, n = closest ? 1 : 4; i < n; i++) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 w = n == 1 ? vec2(1.0) : mix(1.0 - f, f, vec2(corner));
        c += w.x * w.y * texel(p, ivec2(floor(at)) + corner, extension);
    }
    return meant(p, c, divides);
}

// The texture's colour, or its one channel as grey, at mesh coordinates uv.
vec3 texture_color(int index, vec2 uv)
{
    Texture t = textures[index];
    vec3 uv1 = vec3(uv, 1.0);
    vec2 at = vec2(dot(t.u_from_uv, uv1), dot(t.v_from_uv, uv1));
    vec4 c = picture_color(t.picture, at, t.extension, t.closest != 0u, t.divides != 0u);
    return t.channel < 0 ? c.rgb : vec3(c[t.channel]);
}

float texture_value(int index, vec2 uv)
{
    vec3 c = texture_color(index, uv);
    return textures[index].channel < 0 ? dot(c, vec3(0.2126, 0.7152, 0.0722)) : c.r;
}
