// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: materials, textures and the functions that read them. Texels lie in one buffer: exact repeat modes, any size.

#include "lib/layouts.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };
layout(std430) readonly buffer Textures { Texture textures[]; };
layout(std430) readonly buffer Texels { uint texels[]; };  // one word an 8-bit texel, four a float texel

struct Shading {
    vec3 base_color;
    float alpha;
    vec3 emission;  // radiance
    float roughness;
    float metallic;
};

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
    vec4 c;
    if (t.closest != 0u) {
        c = texel(t, ivec2(floor(at)));
    } else {
        vec2 base = floor(at - 0.5), f = at - 0.5 - base;
        ivec2 i = ivec2(base);
        c = mix(mix(texel(t, i), texel(t, i + ivec2(1, 0)), f.x),
                mix(texel(t, i + ivec2(0, 1)), texel(t, i + ivec2(1, 1)), f.x), f.y);
    }
    return t.channel < 0 ? c.rgb : vec3(c[t.channel]);
}

float texture_value(int index, vec2 uv)
{
    vec3 c = texture_color(index, uv);
    return textures[index].channel < 0 ? dot(c, vec3(0.2126, 0.7152, 0.0722)) : c.r;
}

float alpha_at(uint material, vec2 uv, bool has_textures)
{
    Material m = materials[material];
    return has_textures && m.alpha_texture >= 0 ? m.alpha * texture_value(m.alpha_texture, uv) : m.alpha;
}

vec3 emission_at(uint material, vec2 uv, bool has_textures)
{
    Material m = materials[material];
    return has_textures && m.emission_texture >= 0 ? m.emission * texture_color(m.emission_texture, uv) : m.emission;
}

Shading shading_at(uint material, vec2 uv, bool has_textures)
{
    Material m = materials[material];
    Shading s = Shading(m.base_color, m.alpha, emission_at(material, uv, has_textures), m.roughness, m.metallic);
    if (has_textures) {
        if (m.base_color_texture >= 0)
            s.base_color *= texture_color(m.base_color_texture, uv);
        if (m.roughness_texture >= 0)
            s.roughness *= texture_value(m.roughness_texture, uv);
        if (m.metallic_texture >= 0)
            s.metallic *= texture_value(m.metallic_texture, uv);
        s.alpha = alpha_at(material, uv, true);
    }
    return s;
}

// The shading normal after the material's normal map; tangent and bitangent need not be unit vectors.
vec3 mapped_normal(uint material, vec2 uv, vec3 normal, vec3 tangent, vec3 bitangent, bool has_textures)
{
    Material m = materials[material];
    if (!has_textures || m.normal_texture < 0 || dot(tangent, tangent) < 1e-20)
        return normal;
    vec3 t = normalize(tangent - normal * dot(tangent, normal));
    vec3 b = cross(normal, t);
    b *= dot(b, bitangent) < 0.0 ? -1.0 : 1.0;
    vec3 map = 2.0 * texture_color(m.normal_texture, uv) - 1.0;
    vec3 n = map.x * t + map.y * b + map.z * normal;
    n = mix(normal, n, m.normal_strength);
    return dot(n, n) > 1e-12 ? normalize(n) : normal;
}
