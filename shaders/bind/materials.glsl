// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: materials with images, and the functions that read them.

#include "bind/material_rows.glsl"
#include "bind/textures.glsl"

struct Shading {
    vec3 base_color;
    float alpha;
    vec3 emission;  // radiance
    float roughness;
    float metallic;
};

float alpha_at(Material m, vec2 uv)
{
    return m.alpha_texture >= 0 ? m.alpha * texture_value(m.alpha_texture, uv) : m.alpha;
}

vec3 emission_at(Material m, vec2 uv)
{
    return m.emission_texture >= 0 ? m.emission * texture_color(m.emission_texture, uv) : m.emission;
}

Shading shading_at(Material m, vec2 uv)
{
    Shading s = Shading(m.base_color, m.alpha, m.emission, m.roughness, m.metallic);
    int images[5] = int[5](m.base_color_texture, m.alpha_texture, m.emission_texture, m.roughness_texture, m.metallic_texture);
    // Materials have no images or a few: a loop that compilers cannot write out, see texture_color
    for (int i = 0, n = m.program == PROGRAM_MATTE ? 0 : 5; i < n; i++) {
        if (images[i] < 0)
            continue;
        vec3 color = texture_color(images[i], uv);
        float value = textures[images[i]].channel < 0 ? dot(color, vec3(0.2126, 0.7152, 0.0722)) : color.r;
        s.base_color *= i == 0 ? color : vec3(1.0);
        s.alpha *= i == 1 ? value : 1.0;
        s.emission *= i == 2 ? color : vec3(1.0);
        s.roughness *= i == 3 ? value : 1.0;
        s.metallic *= i == 4 ? value : 1.0;
    }
    return s;
}

// The shading normal after the material's normal map; tangent and bitangent need not be unit vectors.
vec3 mapped_normal(Material m, vec2 uv, vec3 normal, vec3 tangent, vec3 bitangent)
{
    if (m.normal_texture < 0 || dot(tangent, tangent) < 1e-20)
        return normal;
    vec3 t = normalize(tangent - normal * dot(tangent, normal));
    vec3 b = cross(normal, t);
    b *= dot(b, bitangent) < 0.0 ? -1.0 : 1.0;
    vec3 map = 2.0 * texture_color(m.normal_texture, uv) - 1.0;
    vec3 n = map.x * t + map.y * b + map.z * normal;
    n = mix(normal, n, m.normal_strength);
    return dot(n, n) > 1e-12 ? normalize(n) : normal;
}
