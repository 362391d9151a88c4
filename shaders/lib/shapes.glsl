// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: grounds that spread light otherwise than Lambert does: how much more, f pi / albedo, by direction. Unit vectors that
// point away from the surface; n the normal on their side.

#include "lib/math.glsl"

const uint SHAPE_LAMBERT = 0u;
const uint SHAPE_OREN_NAYAR = 1u;  // at.x: roughness; color: what is spread once more by facets, less what leaves along wo
const uint SHAPE_SHEEN = 2u;       // at: the two numbers of a cosine that is transformed linearly
const uint SHAPE_VELVET = 3u;      // at.x: roughness
const uint SHAPE_TOON = 4u;        // at: angles at which light begins to fade, and in which it does [rad]
const uint SHAPE_GLOSSY_TOON = 5u; // the same around the mirrored direction

struct Shape {
    uint kind;
    vec2 at;
    vec3 color;
};

const Shape LAMBERT = Shape(SHAPE_LAMBERT, vec2(0.0), vec3(0.0));

float safe_acos(float c)
{
    return acos(clamp(c, -1.0, 1.0));
}

// The improved Oren-Nayar model of Fujii: f = a + b s / t. Its part of the cosine's albedo that depends on the angle.
float oren_nayar_g(float c)
{
    if (c < 1e-6)
        return (PI / 2.0 - 2.0 / 3.0) - c;
    float s = sqrt(max(1.0 - c * c, 0.0));
    return s * (safe_acos(c) - 2.0 / 3.0 - s * c) + 2.0 / 3.0 * (s / c) * (1.0 - s * s * s);
}

// a and b for a roughness from 0 to 1.
vec2 oren_nayar_ab(float roughness)
{
    float a = 1.0 / (PI + roughness * (PI / 2.0 - 2.0 / 3.0));
    return vec2(a, roughness * a);
}

// Share of light along a direction of that cosine that comes back after one scattering from white facets.
float oren_nayar_albedo(vec2 ab, float c)
{
    return ab.x * PI + ab.y * oren_nayar_g(c);
}

// Light that facets of a colour spread more than once, less what its direction of leaving decides: what is missing after one
// scattering, as OpenPBR puts it back.
vec3 oren_nayar_bounces(vec2 ab, vec3 color, float NoV)
{
    float mean = ab.x * PI + (2.0 * PI - 5.6) / 3.0 * ab.y;
    return color * color * (mean / (1.0 - mean)) / (1.0 - color * (1.0 - mean)) * (1.0 - oren_nayar_albedo(ab, NoV));
}

vec3 oren_nayar(Shape shape, float NoV, float NoL, float VoL)
{
    vec2 ab = oren_nayar_ab(shape.at.x);
    float t = VoL - NoL * NoV;
    t = t > 0.0 ? t / max(max(NoL, NoV), 1e-20) : t;
    return PI * (ab.x + ab.y * t) + shape.color * (1.0 - oren_nayar_albedo(ab, NoL));
}

// A rough ground of that colour, seen at that cosine.
Shape rough_ground(vec3 color, float roughness, float NoV)
{
    float r = clamp(roughness, 0.0, 1.0);
    return r < 1e-5 ? LAMBERT : Shape(SHAPE_OREN_NAYAR, vec2(r, 0.0), oren_nayar_bounces(oren_nayar_ab(r), clamp(color, 0.0, 1.0), NoV));
}

// A cosine that is transformed linearly [Zeltner22]: x along wo's shadow on the surface.
float sheen(vec2 at, vec3 wi)
{
    float x = at.x * wi.x + at.y * wi.z, y = at.x * wi.y, k = at.x / (x * x + y * y + wi.z * wi.z);
    return k * k;
}

// f pi of microfacets that stand upright [Ashikhmin00], as Cycles has it.
float velvet(float roughness, float NoV, float NoL, float VoL)
{
    float VoH = sqrt(max(0.5 + 0.5 * VoL, 0.0)), NoH = (NoV + NoL) / max(2.0 * VoH, 1e-6);
    if (NoH > 1.0 - 1e-5 || VoH < 1e-5)
        return 0.0;
    float k = 1.0 / (roughness * roughness), s2 = 1.0 - NoH * NoH, side = 2.0 * max(NoH / VoH, 1e-5);
    float shadowed = min(1.0, side * min(NoV, NoL));
    return 0.25 * exp(-NoH * NoH / s2 * k) * k / (s2 * s2) * shadowed / max(NoV * NoL, 1e-6);
}

// Even up to an angle, then fading.
float one_minus_cos(float angle)
{
    float s = sin(0.5 * angle);
    return 2.0 * s * s;
}

float toon_intensity(vec2 at, float angle)
{
    return angle < at.x ? 1.0 : at.y > 0.0 ? max(1.0 - (angle - at.x) / at.y, 0.0) : 0.0;
}

float toon(vec2 at, float c, float NoL)
{
    float widest = min(at.x + at.y, PI / 2.0), angle = safe_acos(c);
    return angle < widest ? toon_intensity(at, angle) / (2.0 * one_minus_cos(widest) * max(NoL, 1e-4)) : 0.0;
}

// Share of all light from above that comes back.
float toon_share(vec2 at)
{
    float widest = min(at.x + at.y, PI / 2.0), fade = at.x - widest < 0.0 ? widest - at.x : 0.0;
    float even = one_minus_cos(at.x), faded = fade > 0.0 ? cos(at.x) - cos(widest) * (1.0 - fade / at.y) - (sin(widest) - sin(at.x)) / at.y : 0.0;
    return clamp((even + faded) / one_minus_cos(widest), 0.0, 1.0);
}

vec3 shape_factor(Shape shape, vec3 n, vec3 wo, vec3 wi)
{
    float NoV = max(dot(n, wo), 0.0), NoL = max(dot(n, wi), 0.0), VoL = dot(wo, wi);
    if (shape.kind == SHAPE_OREN_NAYAR)
        return oren_nayar(shape, NoV, NoL, VoL);
    if (shape.kind == SHAPE_SHEEN) {
        vec3 across = wo - NoV * n;
        float x = dot(across, wi) / max(length(across), 1e-6), y2 = max(1.0 - NoL * NoL - x * x, 0.0);
        return vec3(sheen(shape.at, vec3(x, sqrt(y2), NoL)));
    }
    if (shape.kind == SHAPE_VELVET)
        return vec3(velvet(shape.at.x, NoV, NoL, VoL));
    return vec3(toon(shape.at, shape.kind == SHAPE_TOON ? NoL : 2.0 * NoV * NoL - VoL, NoL));
}
