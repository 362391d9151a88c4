// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: checkers, bricks, gradients and the magic texture as Cycles has them.

#include "nodes/bounded.glsl"
#include "nodes/hash.glsl"
#include "nodes/texture_space.glsl"

struct Checker {
    vec3 color;
    float factor;
};

Checker texture_checker(vec3 at, vec3 color1, vec3 color2, float scale)
{
    vec3 p = (at * scale + 0.000001) * 0.999999;
    ivec3 odd = ivec3(floor(p)) & 1;
    bool is_first = (odd.x == odd.y) == (odd.z == 1);
    return Checker(is_first ? color1 : color2, is_first ? 1.0 : 0.0);
}

float gradient_linear(vec3 p)
{
    return clamp(p.x, 0.0, 1.0);
}

float gradient_quadratic(vec3 p)
{
    float x = clamp(p.x, 0.0, 1.0);
    return x * x;
}

float gradient_easing(vec3 p)
{
    return smoothstep(0.0, 1.0, p.x);
}

float gradient_diagonal(vec3 p)
{
    return clamp(0.5 * (p.x + p.y), 0.0, 1.0);
}

float gradient_radial(vec3 p)
{
    return p.x == 0.0 && p.y == 0.0 ? 0.5 : clamp(atan(p.y, p.x) / 6.28318530718 + 0.5, 0.0, 1.0);
}

// A little less than 1 from the centre, so that it is 0 all over a unit sphere.
float gradient_spherical(vec3 p)
{
    return clamp(0.999999 - length(p), 0.0, 1.0);
}

float gradient_quadratic_sphere(vec3 p)
{
    float r = gradient_spherical(p);
    return r * r;
}

// depth: how many waves have passed through each other, 0 to 10.
vec3 texture_magic(int depth, vec3 at, float scale, float distortion)
{
    vec3 p = at - 6.28318530718 * trunc(at / 6.28318530718);
    float x = sin((p.x + p.y + p.z) * 5.0 * scale);
    float y = cos((-p.x + p.y - p.z) * 5.0 * scale);
    float z = -cos((-p.x - p.y + p.z) * 5.0 * scale);
    if (depth > 0) {
        x *= distortion;
        z *= distortion;
        y = -cos(x - y * distortion + z) * distortion;
    }
    if (depth > 1)
        x = cos(x - y - z) * distortion;
    if (depth > 2)
        z = sin(-x - y - z) * distortion;
    if (depth > 3)
        x = -cos(-x + y - z) * distortion;
    if (depth > 4)
        y = -sin(-x + y + z) * distortion;
    if (depth > 5)
        y = -cos(-x + y + z) * distortion;
    if (depth > 6)
        x = cos(x + y + z) * distortion;
    if (depth > 7)
        z = sin(x + y - z) * distortion;
    if (depth > 8)
        x = -cos(-x - y + z) * distortion;
    if (depth > 9)
        y = -sin(x - y + z) * distortion;
    vec3 v = vec3(x, y, z);
    return finite_3(0.5 - (distortion != 0.0 ? v / (2.0 * distortion) : v));
}

struct Brick {
    vec3 color;
    float factor;  // 1 in mortar
};

// The tint of a brick, in [0, 1].
float brick_tint(int row, int brick)
{
    uint n = (uint(row) << 16) + (uint(brick) & 0xffffu);
    n = (n + 1013u) & 0x7fffffffu;
    n = (n >> 13) ^ n;
    n = (n * (n * n * 60493u + 19990303u) + 1376312589u) & 0x7fffffffu;
    return 0.5 * float(n) / 1073741824.0;
}

int whole_turns(float x)
{
    return int(floor(clamp(x, -2147483520.0, 2147483520.0)));
}

// rows: the offset of every so manieth row and the number of rows, then the width of bricks in every so manieth row
Brick texture_brick(vec3 at, vec3 color1, vec3 color2, vec3 mortar, float scale, float mortar_size, float mortar_smooth, float bias, float width, float height, float offset, float offset_rows, float squash, float squash_rows)
{
    vec2 p = clamp(at.xy * scale, -1e30, 1e30);
    int row = height != 0.0 ? whole_turns(p.y / height) : 0;
    if (offset_rows >= 1.0 && squash_rows >= 1.0) {
        width *= abs(row) % int(squash_rows) != 0 ? 1.0 : squash;
        p.x += abs(row) % int(offset_rows) != 0 ? 0.0 : width * offset;
    }
    int brick = width != 0.0 ? whole_turns(p.x / width) : 0;
    vec2 inside = p - vec2(width * float(brick), height * float(row));
    float tint = clamp(brick_tint(row, brick) + bias, 0.0, 1.0);
    float edge = min(min(inside.x, inside.y), min(width - inside.x, height - inside.y));
    float share = 0.0;
    if (edge < mortar_size)
        share = mortar_smooth == 0.0 ? 1.0 : smoothstep(0.0, 1.0, (1.0 - edge / mortar_size) / mortar_smooth);
    return Brick(bounded3(mix(mix(color1, color2, tint), mortar, share)), share);
}

float white_noise(int n, vec3 at, float w)
{
    return hash_of(texture_point(n, at, w, 1.0), n);
}

vec3 white_noise_color(int n, vec3 at, float w)
{
    vec4 k = texture_point(n, at, w, 1.0);
    if (n == 1)
        return vec3(hash_of(k, 1), hash_of_2(k.x, 1.0), hash_of_2(k.x, 2.0));
    if (n == 2)
        return vec3(hash_of(k, 2), hash_of_3(vec3(k.xy, 1.0)), hash_of_3(vec3(k.xy, 2.0)));
    if (n == 3)
        return vec3(hash_of(k, 3), hash_of(vec4(k.xyz, 1.0), 4), hash_of(vec4(k.xyz, 2.0), 4));
    return vec3(hash_of(k, 4), hash_of(k.zxwy, 4), hash_of(k.wzyx, 4));
}
