// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: vectors and colours from numbers, and back.

vec3 combined(float x, float y, float z)
{
    return vec3(x, y, z);
}

float first_of(vec3 v)
{
    return v.x;
}

float second_of(vec3 v)
{
    return v.y;
}

float third_of(vec3 v)
{
    return v.z;
}
