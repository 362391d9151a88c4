// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: microfacets: GGX normals, Smith's shadowing, Fresnel reflectances. Directions are unit vectors in the surface's
// frame, whose z is its normal.

#include "lib/math.glsl"

// Distribution of microfacet normals h [Walter07], alpha = roughness^2 along x and y. No difference of large numbers: exact at
// any alpha.
float ggx_normals(vec3 h, vec2 alpha)
{
    float k = h.x * h.x * (alpha.y / alpha.x) + h.y * h.y * (alpha.x / alpha.y) + alpha.x * alpha.y * h.z * h.z;
    return alpha.x * alpha.y / (PI * k * k);
}

float ggx_normals(vec3 h, float alpha)
{
    return ggx_normals(h, vec2(alpha));
}

// Smith's Lambda under GGX [Heitz14]: a direction sees 1 / (1 + Lambda) of the microfacets that face it, and two
// directions 1 / (1 + Lambda + Lambda').
float ggx_lambda(vec3 w, vec2 alpha)
{
    vec2 slope = alpha * w.xy;
    return 0.5 * (sqrt(1.0 + dot(slope, slope) / max(w.z * w.z, 1e-20)) - 1.0);
}

float ggx_lambda(vec3 w, float alpha)
{
    return ggx_lambda(w, vec2(alpha));
}

// One of the normals that wo sees [Heitz18]; their density is D max(wo.h, 0) / (wo.z (1 + Lambda(wo))).
vec3 visible_normal(vec3 wo, vec2 alpha, vec2 u)
{
    vec3 stretched = normalize(vec3(alpha * wo.xy, wo.z));
    vec2 p = disk_point(u);
    p.y = mix(sqrt(max(1.0 - p.x * p.x, 0.0)), p.y, 0.5 * (1.0 + stretched.z));
    bool is_upright = dot(stretched.xy, stretched.xy) < 1e-12;
    vec3 t1 = is_upright ? vec3(1.0, 0.0, 0.0) : normalize(vec3(-stretched.y, stretched.x, 0.0));
    vec3 h = p.x * t1 + p.y * cross(stretched, t1) + sqrt(max(1.0 - dot(p, p), 0.0)) * stretched;
    return normalize(vec3(alpha * h.xy, max(h.z, 1e-6)));
}

vec3 visible_normal(vec3 wo, float alpha, vec2 u)
{
    return visible_normal(wo, vec2(alpha), u);
}

// Reflectance at normal incidence for an index of refraction, and the index above 1 for a reflectance.
float f0_of_ior(float ior)
{
    float r = (ior - 1.0) / (ior + 1.0);
    return r * r;
}

float ior_of_f0(float f0)
{
    float r = sqrt(clamp(f0, 0.0, 0.99));
    return (1.0 + r) / (1.0 - r);
}

// Fresnel reflectance of an interface, c the cosine before it, eta the index beyond over the one before it [Walter07].
float f_dielectric(float c, float eta)
{
    float g2 = eta * eta - 1.0 + c * c;
    if (g2 <= 0.0)
        return 1.0;
    float g = sqrt(g2), a = (g - c) / (g + c), b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Its mean 2 int F(c) c dc, a fit [Kulla17].
float f_dielectric_mean(float eta)
{
    return eta < 1.0 ? 0.997118 + eta * (0.1014 - eta * (0.965241 + eta * 0.130607)) : (eta - 1.0) / (4.08567 + 1.00071 * eta);
}

// Where between 0 and 1 a reflectance F lies that goes from the interface's own at normal incidence to 1.
float share_of_f(float f, float eta)
{
    float own = f0_of_ior(eta);
    return clamp((f - own) / (1.0 - own), 0.0, 1.0);
}

// A curve from f0 to 1 at that place.
vec3 f_from(vec3 f0, float f, float eta)
{
    return mix(f0, vec3(1.0), share_of_f(f, eta));
}

// Schlick's curve less a dip towards grazing angles, whose depth `b` makes it `tint` times as bright at cos = 1/7 [Kutz21].
vec3 f82_dip(vec3 f0, vec3 tint)
{
    float f5 = pow(6.0 / 7.0, 5.0);
    return mix(f0, vec3(1.0), f5) * (1.0 - tint) * (7.0 / (f5 * 6.0 / 7.0));
}

vec3 f82(vec3 f0, vec3 b, float c)
{
    float m = clamp(1.0 - c, 0.0, 1.0), m5 = m * m * m * m * m;
    return clamp(mix(f0, vec3(1.0), m5) - b * (c * m5 * m), 0.0, 1.0);
}

// Its mean 2 int F(c) c dc.
vec3 f82_mean(vec3 f0, vec3 b)
{
    return mix(f0, vec3(1.0), 1.0 / 21.0) - b / 126.0;
}
