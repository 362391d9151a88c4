// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: closures that spread light as cloth does, and as cartoons do.

#include "nodes/closures.glsl"

// Share of light that fibres send back once or more often, seen at a cosine: the fit of MaterialX to [Zeltner22]'s table.
float sheen_albedo(float NoV, float roughness)
{
    float c = clamp(NoV, 0.0, 1.0), r = clamp(roughness, 0.01, 1.0);
    float width = r * (0.0206607 + 1.58491 * r) / (0.0379424 + r * (1.32227 + r));
    float middle = r * (-0.193854 + r * (-1.14885 + r * (1.7932 - 0.95943 * r * r))) / (0.046391 + r);
    float least = r * (0.000654023 + (-0.0207818 + 0.119681 * r) * r) / (1.26264 + r * (-1.92021 + r));
    float x = (c - middle) / width;
    return clamp(exp(-0.5 * x * x) / (width * sqrt(2.0 * PI)) + least, 0.0, 1.0);
}

// The two numbers of the transformed cosine, by the same source.
vec2 sheen_transform(float NoV, float roughness)
{
    float c = clamp(NoV, 0.0, 1.0), r = clamp(roughness, 0.01, 1.0);
    float a = (2.58126 * c + 0.813703 * r) * r / (1.0 + 0.310327 * c * c + 2.60994 * c * r);
    float b = sqrt(1.0 - c) * (r - 1.0) * r * r * r / (0.0000254053 + 1.71228 * c - 1.71506 * c * r + 1.34174 * r * r);
    return vec2(max(a, 1e-3), b);
}

// Fibres that get `weight` of the light; their albedo without that.
vec3 add_sheen(inout Closures c, vec3 weight, Geo g, float roughness, vec3 normal)
{
    float NoV = dot(normal, g.wo), albedo = sheen_albedo(NoV, roughness);
    add_ground(c, weight * albedo, normal, Shape(SHAPE_SHEEN, sheen_transform(NoV, roughness), vec3(0.0)));
    return vec3(albedo);
}

void closure_sheen(inout Closures c, float weight, Geo g, vec3 color, float roughness, vec3 normal)
{
    vec3 tint = weight * max(color, 0.0);
    c.mean += tint * sheen_albedo(0.5, roughness);
    add_sheen(c, tint, g, roughness, seen_normal(g, normal));
}

// Upright fibres, without what they scatter more than once.
void closure_velvet(inout Closures c, float weight, Geo g, vec3 color, float roughness, vec3 normal)
{
    vec3 tint = weight * max(color, 0.0);
    c.mean += 0.25 * tint;
    add_ground(c, tint, seen_normal(g, normal), Shape(SHAPE_VELVET, vec2(clamp(roughness, 0.01, 1.0), 0.0), vec3(0.0)));
}

// is_glossy: around the mirrored direction, not the normal.
void closure_toon(inout Closures c, float weight, Geo g, vec3 color, float size, float smoothness, vec3 normal, bool is_glossy)
{
    vec2 at = vec2(clamp(size, 1e-5, 1.0), clamp(smoothness, 0.0, 1.0)) * (PI / 2.0);
    vec3 albedo = weight * max(color, 0.0);
    c.mean += albedo * toon_share(at);
    add_ground(c, albedo, seen_normal(g, normal), Shape(is_glossy ? SHAPE_GLOSSY_TOON : SHAPE_TOON, at, vec3(0.0)));
}
