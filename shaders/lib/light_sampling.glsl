// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: a point on a lamp and what it brings, either drawn or met by a ray. What a point brings times the density with
// which it is drawn is the lamp's radiance there.

#include "lib/layouts.glsl"
#include "lib/math.glsl"

struct LightSample {
    vec3 wi;         // unit, towards the lamp
    float distance;  // metres; infinite for the sun
    vec3 E_perp;     // [W m^-2] on a surface that faces it; the mean over u in [0,1)^2 is the lamp's unshadowed irradiance
    float pdf;       // [sr^-1] with which wi is drawn; 0 for lamps without a size
};

const LightSample NO_LIGHT = LightSample(vec3(0.0), 0.0, vec3(0.0), 0.0);

// A sphere of radius r radiates L = I / (pi r^2). Directions uniform in the solid angle that it covers,
// omega = 2 pi (1 - cos) with sin = r / d, give L omega = 2 I / (d^2 (1 + cos)): right for r = 0 too.
struct Cap {
    vec3 to_centre;
    float d2;
    float sin2;
    float one_minus_cos;
};

Cap cap_of(Light light, vec3 p)
{
    vec3 to_centre = light.position - p;
    float d2 = max(dot(to_centre, to_centre), 1e-12);
    float sin2 = min(light.size.x * light.size.x / d2, 0.9999);
    return Cap(to_centre, d2, sin2, sin2 / (1.0 + sqrt(1.0 - sin2)));
}

LightSample sphere_along(Light light, Cap cap, vec3 wi, float cos_theta, float sin2_theta)
{
    float inside = max(light.size.x * light.size.x - cap.d2 * sin2_theta, 0.0);
    float distance = max(sqrt(cap.d2) * cos_theta - sqrt(inside), 0.0);
    vec3 E_perp = light.emitted * (2.0 / (cap.d2 * (2.0 - cap.one_minus_cos)));
    return LightSample(wi, distance, E_perp, cap.sin2 > 0.0 ? 0.5 / (PI * cap.one_minus_cos) : 0.0);
}

LightSample sample_sphere(Light light, vec3 p, vec2 u)
{
    Cap cap = cap_of(light, p);
    float one_minus_cos = cap.one_minus_cos * u.x, cos_theta = 1.0 - one_minus_cos, phi = 2.0 * PI * u.y;
    float sin2 = max(one_minus_cos * (1.0 + cos_theta), 0.0);
    vec3 wi = frame_of(cap.to_centre * inversesqrt(cap.d2)) * vec3(sqrt(sin2) * vec2(cos(phi), sin(phi)), cos_theta);
    return sphere_along(light, cap, wi, cos_theta, sin2);
}

LightSample meet_sphere(Light light, vec3 p, vec3 d)
{
    Cap cap = cap_of(light, p);
    vec3 centre = cap.to_centre * inversesqrt(cap.d2), across = cross(centre, d);
    float sin2 = dot(across, across), cosine = dot(centre, d);
    return cosine > 0.0 && sin2 < cap.sin2 ? sphere_along(light, cap, d, cosine, sin2) : NO_LIGHT;
}

// A disk of radius r that faces p, whatever p is: L = I / (pi r^2) and E_perp = L A cos / d^2.
LightSample facing_disk_at(Light light, float d_centre, vec3 to_light)
{
    float d2 = max(dot(to_light, to_light), 1e-12), d = sqrt(d2), area = PI * light.size.x * light.size.x;
    float per_area = d_centre / (d2 * d);
    return LightSample(to_light / d, d, light.emitted * per_area, area > 0.0 ? 1.0 / (area * per_area) : 0.0);
}

LightSample sample_facing_disk(Light light, vec3 p, vec2 u)
{
    vec3 to_centre = light.position - p;
    float d_centre = max(length(to_centre), 1e-6);
    vec3 to_light = frame_of(to_centre / d_centre) * vec3(light.size.x * disk_point(u), d_centre);
    return facing_disk_at(light, d_centre, to_light);
}

LightSample meet_facing_disk(Light light, vec3 p, vec3 d)
{
    vec3 to_centre = light.position - p;
    float d2 = max(dot(to_centre, to_centre), 1e-12), along = dot(to_centre, d);
    vec3 to_light = d * (d2 / along);
    return along > 0.0 && distance(to_light, to_centre) < light.size.x ? facing_disk_at(light, sqrt(d2), to_light) : NO_LIGHT;
}

// Brightness across a spot's cone: 1 inside, smooth to 0 over the blend, 0 outside.
float spot_falloff(Light light, vec3 wi)
{
    float cosine = dot(wi, light.axis_z);
    float t = clamp((cosine - light.spot_cos) / max((1.0 - light.spot_cos) * light.spot_blend, 1e-6), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Every direction of the sun's flat disk brings the same share of E: dw = cos^3 dA.
LightSample sun_along(Light light, vec3 wi)
{
    float cosine = dot(wi, light.axis_z), area = PI * light.size.x * light.size.x;
    return LightSample(wi, INFINITE, light.emitted, area > 0.0 ? 1.0 / (area * cosine * cosine * cosine) : 0.0);
}

LightSample sample_sun(Light light, vec2 u)
{
    vec2 disk = light.size.x * disk_point(u);
    return sun_along(light, normalize(light.axis_z + disk.x * light.axis_x + disk.y * light.axis_y));
}

LightSample meet_sun(Light light, vec3 d)
{
    float cosine = dot(d, light.axis_z);
    return cosine > 0.0 && length(cross(d, light.axis_z)) < light.size.x * cosine ? sun_along(light, d) : NO_LIGHT;
}

// tan h - h, by its series where rounding would leave little of the difference.
float tan_excess(float h)
{
    float h2 = h * h;
    return h < 0.3 ? h * h2 * (1.0 / 3.0 + h2 * (2.0 / 15.0 + h2 * 17.0 / 315.0)) : tan(h) - h;
}

// Points uniform on the lamp's front: E_perp = L A cos / d^2. A spread of 2 h < pi narrows the lobe to
// (tan h - tan a) / (tan h - h), whose flux is that of the full lobe.
LightSample area_at(Light light, vec3 to_light)
{
    float area = (light.is_ellipse != 0u ? PI : 4.0) * light.size.x * light.size.y;
    float d2 = max(dot(to_light, to_light), 1e-12);
    vec3 wi = to_light * inversesqrt(d2);
    float solid_angle = area * max(dot(wi, light.axis_z), 0.0) / d2;
    float cosine = dot(wi, light.axis_z), h = max(0.5 * light.spread, 1e-4), lobe = 1.0;
    if (h < 0.4999 * PI && cosine > 0.0)
        lobe = max(tan(h) - length(cross(wi, light.axis_z)) / cosine, 0.0) / tan_excess(h);
    return LightSample(wi, sqrt(d2), light.emitted * (lobe * solid_angle), solid_angle > 0.0 ? 1.0 / solid_angle : 0.0);
}

LightSample sample_area(Light light, vec3 p, vec2 u)
{
    vec2 local = light.size * (light.is_ellipse != 0u ? disk_point(u) : 2.0 * u - 1.0);
    return area_at(light, light.position + local.x * light.axis_x + local.y * light.axis_y - p);
}

LightSample meet_area(Light light, vec3 p, vec3 d)
{
    vec3 to_centre = light.position - p;
    float cosine = dot(d, light.axis_z);
    vec3 to_light = d * (dot(to_centre, light.axis_z) / cosine), off = to_light - to_centre;
    vec2 local = abs(vec2(dot(off, light.axis_x), dot(off, light.axis_y))) / light.size;
    float outside = light.is_ellipse != 0u ? length(local) : max(local.x, local.y);
    return cosine > 0.0 && dot(to_light, d) > 0.0 && outside < 1.0 ? area_at(light, to_light) : NO_LIGHT;
}

// A point of the lamp as seen from p.
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

// The point of the lamp that a ray from p along unit d meets, if it meets it and the lamp has a size; else pdf is 0.
LightSample meet_light(Light light, vec3 p, vec3 d)
{
    if (light.kind == LIGHT_SUN)
        return meet_sun(light, d);
    if (light.kind == LIGHT_AREA)
        return meet_area(light, p, d);
    LightSample s = light.soft_falloff != 0u ? meet_facing_disk(light, p, d) : meet_sphere(light, p, d);
    if (light.kind == LIGHT_SPOT)
        s.E_perp *= spot_falloff(light, s.wi);
    return s;
}
