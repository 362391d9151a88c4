// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: a point on a lamp and what it brings. E_perp is the irradiance [W m^-2] of a surface that faces it.

#include "lib/layouts.glsl"
#include "lib/math.glsl"

struct LightSample {
    vec3 wi;         // unit, towards the lamp
    float distance;  // metres; infinite for the sun
    vec3 E_perp;     // mean over u in [0,1)^2 is the lamp's unshadowed irradiance
};

// A sphere of radius r radiates L = I / (pi r^2). Directions uniform in the solid angle that it covers,
// omega = 2 pi (1 - cos) with sin = r / d, give L omega = 2 I / (d^2 (1 + cos)): right for r = 0 too.
LightSample sample_sphere(Light light, vec3 p, vec2 u)
{
    vec3 to_centre = light.position - p;
    float d2 = max(dot(to_centre, to_centre), 1e-12), d = sqrt(d2);
    float s2 = min(light.size.x * light.size.x / d2, 0.9999);
    float cos_max = sqrt(1.0 - s2);
    float one_minus_cos = s2 / (1.0 + cos_max) * u.x, cos_theta = 1.0 - one_minus_cos;
    float sin_theta = sqrt(max(one_minus_cos * (1.0 + cos_theta), 0.0)), phi = 2.0 * PI * u.y;
    vec3 wi = frame_of(to_centre / d) * vec3(sin_theta * cos(phi), sin_theta * sin(phi), cos_theta);
    float inside = max(light.size.x * light.size.x - d2 * sin_theta * sin_theta, 0.0);
    return LightSample(wi, max(d * cos_theta - sqrt(inside), 0.0), light.emitted * (2.0 / (d2 * (1.0 + cos_max))));
}

// A disk of radius r that faces p, whatever p is: L = I / (pi r^2) and E_perp = L A cos / d^2.
LightSample sample_facing_disk(Light light, vec3 p, vec2 u)
{
    vec3 to_centre = light.position - p;
    float d_centre = max(length(to_centre), 1e-6);
    vec3 to_light = frame_of(to_centre / d_centre) * vec3(light.size.x * disk_point(u), d_centre);
    float d2 = max(dot(to_light, to_light), 1e-12), d = sqrt(d2);
    return LightSample(to_light / d, d, light.emitted * (d_centre / (d2 * d)));
}

// Brightness across a spot's cone: 1 inside, smooth to 0 over the blend, 0 outside.
float spot_falloff(Light light, vec3 wi)
{
    float cosine = dot(wi, light.axis_z);
    float t = clamp((cosine - light.spot_cos) / max((1.0 - light.spot_cos) * light.spot_blend, 1e-6), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Every direction of the sun's disk brings the same share of E.
LightSample sample_sun(Light light, vec2 u)
{
    vec2 disk = light.size.x * disk_point(u);
    return LightSample(normalize(light.axis_z + disk.x * light.axis_x + disk.y * light.axis_y), INFINITE, light.emitted);
}

// tan h - h, by its series where rounding would leave little of the difference.
float tan_excess(float h)
{
    float h2 = h * h;
    return h < 0.3 ? h * h2 * (1.0 / 3.0 + h2 * (2.0 / 15.0 + h2 * 17.0 / 315.0)) : tan(h) - h;
}

// Points uniform on the lamp's front: E_perp = L A cos / d^2. A spread of 2 h < pi narrows the lobe to
// (tan h - tan a) / (tan h - h), whose flux is that of the full lobe.
LightSample sample_area(Light light, vec3 p, vec2 u)
{
    vec2 local = light.is_ellipse != 0u ? disk_point(u) : 2.0 * u - 1.0;
    float area = (light.is_ellipse != 0u ? PI : 4.0) * light.size.x * light.size.y;
    vec3 to_light = light.position + local.x * light.size.x * light.axis_x + local.y * light.size.y * light.axis_y - p;
    float d2 = max(dot(to_light, to_light), 1e-12);
    vec3 wi = to_light * inversesqrt(d2);
    float cosine = max(dot(wi, light.axis_z), 0.0);
    float h = max(0.5 * light.spread, 1e-4), lobe = 1.0;
    if (h < 0.4999 * PI && cosine > 0.0)
        lobe = max(tan(h) - length(cross(wi, light.axis_z)) / cosine, 0.0) / tan_excess(h);
    return LightSample(wi, sqrt(d2), light.emitted * (area * cosine * lobe / d2));
}

LightSample sample_light(Light light, vec3 p, vec2 u)
{
    if (light.kind == LIGHT_SUN)
        return sample_sun(light, u);
    if (light.kind == LIGHT_AREA)
        return sample_area(light, p, u);
    LightSample s = light.soft_falloff != 0u ? sample_facing_disk(light, p, u) : sample_sphere(light, p, u);
    if (light.kind == LIGHT_SPOT)
        s.E_perp *= spot_falloff(light, s.wi);
    return s;
}
