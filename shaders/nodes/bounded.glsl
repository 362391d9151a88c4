// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: arithmetic that stays finite, as all nodes do for finite input.

const float LARGEST = 3.4e38;

// What has overflowed is the largest number, so that one over it is nothing; what is no number is 0.
float bounded(float x)
{
    bool is_number = (floatBitsToUint(x) & 0x7fffffffu) <= 0x7f800000u;
    return is_number ? clamp(x, -LARGEST, LARGEST) : 0.0;
}

vec3 bounded3(vec3 v)
{
    return vec3(bounded(v.x), bounded(v.y), bounded(v.z));
}

// 0 where b is.
float divided(float a, float b)
{
    return b != 0.0 ? bounded(a / b) : 0.0;
}

vec3 divided3(vec3 a, vec3 b)
{
    return vec3(divided(a.x, b.x), divided(a.y, b.y), divided(a.z, b.z));
}

// Length of any finite vector: squares of its components may overflow and vanish.
float length_of(vec3 v)
{
    vec3 a = abs(v);
    float largest = max(a.x, max(a.y, a.z));
    return largest > 1e-18 && largest < 1e18 ? length(v) : bounded(largest * length(divided3(v, vec3(largest))));
}

// Unit vector, 0 of 0.
vec3 unit_of(vec3 v)
{
    vec3 a = abs(v);
    float largest = max(a.x, max(a.y, a.z));
    vec3 scaled = divided3(v, vec3(largest));
    return largest != 0.0 ? scaled / length(scaled) : vec3(0.0);
}
