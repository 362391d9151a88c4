// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: attributes by number, as nodes give them.

#include "bind/attributes.glsl"

vec3 attribute_vector(Geo g, uint number)
{
    return attribute_at(g, number).xyz;
}

// The mean of three, the first of two.
float attribute_factor(Geo g, uint number)
{
    Attribute a = attribute_of(g, number);
    return a.width > 2u ? (a.value.x + a.value.y + a.value.z) / 3.0 : a.value.x;
}

float attribute_alpha(Geo g, uint number)
{
    return attribute_at(g, number).w;
}

// Of a colour attribute, which covers nothing where it is missing.
float color_attribute_alpha(Geo g, uint number)
{
    Attribute a = attribute_of(g, number);
    return a.width > 0u ? a.value.w : 0.0;
}

// One of its four numbers; zero where it is missing.
float attribute_component(Geo g, uint number, int i)
{
    Attribute a = attribute_of(g, number);
    return a.width > 0u ? a.value[i] : 0.0;
}

float attribute_number(Geo g, uint number)
{
    return attribute_at(g, number).x;
}

vec3 object_color(Geo g)
{
    return has_object(g) ? shown[g.instance].color.rgb : vec3(0.0);
}

float object_alpha(Geo g)
{
    return has_object(g) ? shown[g.instance].color.a : 0.0;
}

float object_random(Geo g)
{
    return has_object(g) ? shown[g.instance].random : 0.0;
}

float object_number(Geo g)
{
    return has_object(g) ? float(shown[g.instance].object_index) : 0.0;
}

vec3 object_origin(Geo g)
{
    return object_location(g);
}

uint turned_left(uint x, int by)
{
    return x << by | x >> (32 - by);
}

// Random number of a particle, as Cycles has it: Jenkins' lookup3 of its index and zero.
float random_of_index(float index)
{
    uint a = 0xdeadbeefu + 8u + 13u, b = a, c = a;
    a += uint(max(index, 0.0));
    c = (c ^ b) - turned_left(b, 14);
    a = (a ^ c) - turned_left(c, 11);
    b = (b ^ a) - turned_left(a, 25);
    c = (c ^ b) - turned_left(b, 16);
    a = (a ^ c) - turned_left(c, 4);
    b = (b ^ a) - turned_left(a, 14);
    return float((c ^ b) - turned_left(b, 24)) / 4294967295.0;
}
