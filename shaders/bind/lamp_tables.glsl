// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what lamps' nodes make of their light, by direction or by place on the lamp, from tables that were baked.

#include "lib/light_sampling.glsl"

const float WIDE_SPOT = 0.17;  // cosine of half a spot's angle below which its table is of all directions

uniform bool u_lamps_have_nodes;          // whether any has a table, or another falloff than the square of the distance
uniform usamplerBuffer u_lamp_tables;  // RGB as bits of floats

// The table's texel: columns go round if it is of all directions.
vec3 lamp_texel(Light light, ivec2 at, bool goes_round)
{
    ivec2 size = ivec2(light.table_size & 0xffffu, light.table_size >> 16u);
    at.x = goes_round ? (at.x + size.x) % size.x : clamp(at.x, 0, size.x - 1);
    at.y = clamp(at.y, 0, size.y - 1);
    return uintBitsToFloat(texelFetch(u_lamp_tables, int(light.table) + at.y * size.x + at.x).rgb);
}

// Where the table has the point of the lamp that a sample from p has found: of area lamps by place, of others by direction.
vec2 lamp_uv(Light light, vec3 p, LightSample s, out bool goes_round)
{
    mat3 axes = mat3(light.axis_x, light.axis_y, light.axis_z);
    goes_round = false;
    if (light.kind == LIGHT_AREA)
        return 0.5 + 0.5 * ((p + s.wi * s.distance - light.position) * axes).xy / max(light.size, 1e-20);
    vec3 d = -s.wi * axes;
    if (light.kind == LIGHT_SPOT && light.spot_cos > WIDE_SPOT) {
        float tangent = sqrt(1.0 - light.spot_cos * light.spot_cos) / light.spot_cos;
        return 0.5 + 0.5 * d.xy / (max(-d.z, 1e-6) * tangent);
    }
    goes_round = true;
    return vec2(0.5 - (d.x != 0.0 || d.y != 0.0 ? atan(d.y, d.x) : 0.0) / (2.0 * PI), 0.5 + atan(d.z, length(d.xy)) / PI);
}

// What its nodes make of a lamp's light on the way to where it arrives.
float falloff_over(Light light, float distance)
{
    float d2 = distance * distance, factor = light.falloff == FALLOFF_LINEAR ? distance : 1.0;
    if (light.falloff == FALLOFF_CONSTANT)
        factor = d2;
    return light.smoothing > 0.0 ? factor * d2 / (light.smoothing + d2) : factor;
}

// What its table makes of a lamp's light that a sample from p has found.
vec3 lamp_factor(Light light, vec3 p, LightSample s)
{
    ivec2 size = ivec2(light.table_size & 0xffffu, light.table_size >> 16u);
    if (size.y == 0 || s.distance <= 0.0)
        return vec3(1.0);
    bool goes_round;
    vec2 at = lamp_uv(light, p, s, goes_round) * vec2(size) - 0.5, f = fract(at);
    ivec2 low = ivec2(floor(at));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; i++) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 w = mix(1.0 - f, f, vec2(corner));
        sum += w.x * w.y * lamp_texel(light, low + corner, goes_round);
    }
    return sum;
}

LightSample with_nodes(Light light, vec3 p, LightSample s)
{
    if (u_lamps_have_nodes && s.E_perp != vec3(0.0))
        s.E_perp *= falloff_over(light, s.distance) * lamp_factor(light, p, s);
    return s;
}

// As sample_light and meet_light, with what the lamp's nodes make of it.
LightSample sample_lamp(Light light, vec3 p, vec2 u)
{
    return with_nodes(light, p, sample_light(light, p, u));
}

LightSample meet_lamp(Light light, vec3 p, vec3 d)
{
    return with_nodes(light, p, meet_light(light, p, d));
}
