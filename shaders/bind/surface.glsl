// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: a surface as something that looks at it sees it, by eye or by ray: with its normal map.

#include "bind/geometry.glsl"
#include "bind/materials.glsl"

Surface seen_surface(uint instance, uint triangle, vec2 bary, vec3 wo, bool has_textures)
{
    Surface s = surface_at(instance, triangle, bary, wo, has_textures);
    s.normal = mapped_normal(s.material, s.uv, s.normal, s.tangent, s.bitangent, has_textures);
    // A shading normal that faces away would see nothing: bend it until it grazes
    float NoV = dot(s.normal, wo);
    if (NoV < 1e-3)
        s.normal = normalize(s.normal + (1e-3 - NoV) * wo);
    return s;
}
