// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: images and the functions that read them. Texels lie in one buffer: exact repeat modes, any size.

#include "lib/layouts.glsl"

layout(std430) readonly buffer Textures { Texture textures[]; };
layout(std430) readonly buffer Texels { uint texels[]; };  // one word an 8-bit texel, four a float texel

vec3 linear_of_srgb(vec3 c)
{
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
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

vec4 texel(Texture t, ivec2 at)
{
    int x = extended(at.x, t.width, t.extension), y = extended(at.y, t.height, t.extension);
    if (x < 0 || y < 0)
        return vec4(0.0);
    uint i = uint(y * t.width + x);
    if (t.format == FORMAT_FLOAT) {
        uint w = t.first_word + 4u * i;
        return uintBitsToFloat(uvec4(texels[w], texels[w + 1u], texels[w + 2u], texels[w + 3u]));
    }
    vec4 c = unpackUnorm4x8(texels[t.first_word + i]);
    return t.format == FORMAT_SRGB8 ? vec4(linear_of_srgb(c.rgb), c.a) : c;
}

// The texture's colour, or its one channel as grey, at mesh coordinates uv.
vec3 texture_color(int index, vec2 uv)
{
    Texture t = textures[index];
    vec3 uv1 = vec3(uv, 1.0);
    vec2 at = vec2(dot(t.u_from_uv, uv1), dot(t.v_from_uv, uv1)) * vec2(t.width, t.height);
    at -= t.closest != 0u ? vec2(0.0) : vec2(0.5);
    vec2 f = fract(at);
    vec4 c = vec4(0.0);
    // A loop whose end compilers do not know: they would write out all four, at every place that reads an image
    for (int i = 0, n = t.closest != 0u ? 1 : 4; i < n; i++) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 w = n == 1 ? vec2(1.0) : mix(1.0 - f, f, vec2(corner));
        c += w.x * w.y * texel(t, ivec2(floor(at)) + corner);
    }
    return t.channel < 0 ? c.rgb : vec3(c[t.channel]);
}

float texture_value(int index, vec2 uv)
{
    vec3 c = texture_color(index, uv);
    return textures[index].channel < 0 ? dot(c, vec3(0.2126, 0.7152, 0.0722)) : c.r;
}
