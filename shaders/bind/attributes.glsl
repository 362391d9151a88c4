// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what trees ask for of meshes and instances: attributes by number, numbers of instances, object space.

#include "bind/geo.glsl"

layout(std430) readonly buffer ShownInstances { Shown shown[]; };  // in the device's order
uniform mat4 u_place;                  // world_from_object of what is no mesh: of a lamp; of the world it changes nothing
uniform usampler2DArray u_attributes;  // for each mesh and number two words, ATTRIBUTE_* and width; then the values

struct Attribute {
    vec4 value;   // one number as grey, 0 beyond the width of two, alpha 1 where there is none
    uint width;   // how many numbers it has; 0 where it is missing
};

uint attribute_word(uint i)
{
    return texelFetch(u_attributes, ivec3(i % WORDS_WIDTH, i / WORDS_WIDTH % WORDS_HEIGHT, i / (WORDS_WIDTH * WORDS_HEIGHT)), 0).x;
}

bool has_object(Geo g)
{
    return g.instance < HIT_DONE;
}

// Interpolated at g. An attribute's first word is such that elements are counted over all meshes, modulo 2^32.
Attribute attribute_of(Geo g, uint number)
{
    Attribute a = Attribute(vec4(0.0, 0.0, 0.0, 1.0), 0u);
    if (!has_object(g))
        return a;
    uint row = 2u * (shown[g.instance].first_row + number), first = attribute_word(row), kind = attribute_word(row + 1u);
    uint domain = kind >> 3u;
    a.width = kind & 7u;
    if (a.width == 0u)
        return a;
    uvec3 elements = domain == ATTRIBUTE_POINT ? triangles[g.triangle].xyz
                   : domain == ATTRIBUTE_CORNER ? 3u * g.triangle + uvec3(0u, 1u, 2u)
                   : uvec3(domain == ATTRIBUTE_FACE ? g.triangle : shown[g.instance].number);
    vec3 weights = vec3(1.0 - g.bary.x - g.bary.y, g.bary);
    int n_corners = domain == ATTRIBUTE_FACE || domain == ATTRIBUTE_INSTANCE ? 1 : 3;
    vec4 sum = vec4(0.0);
    // Loops whose ends compilers do not know, see texture_color
    for (int c = 0; c < n_corners; c++)
        for (uint i = 0u; i < a.width; i++)
            sum[i] += (n_corners == 1 ? 1.0 : weights[c]) * uintBitsToFloat(attribute_word(first + a.width * elements[c] + i));
    a.value = a.width == 4u ? sum : vec4(a.width == 1u ? sum.xxx : sum.xyz, 1.0);
    return a;
}

vec4 attribute_at(Geo g, uint number)
{
    return attribute_of(g, number).value;
}

// Columns of world_from_object without its translation.
mat3 world_from_object(Geo g)
{
    if (!has_object(g))
        return mat3(u_place);
    Instance i = instances[g.instance];
    return transpose(mat3(i.row_x.xyz, i.row_y.xyz, i.row_z.xyz));
}

vec3 object_location(Geo g)
{
    if (!has_object(g))
        return u_place[3].xyz;
    Instance i = instances[g.instance];
    return vec3(i.row_x.w, i.row_y.w, i.row_z.w) + u_centre;
}

// Inverse of a matrix; zeros where there is none.
mat3 inverse_of(mat3 m)
{
    return determinant(m) != 0.0 ? inverse(m) : mat3(0.0);
}

// 0 also of what has overflowed; squares of its parts may not overflow or vanish.
vec3 unit_or_zero(vec3 v)
{
    vec3 a = abs(v);
    float largest = max(a.x, max(a.y, a.z));
    return largest > 0.0 && largest <= 3.4e38 ? normalize(v / largest) : vec3(0.0);
}

vec3 point_to_object(Geo g, vec3 p)
{
    return inverse_of(world_from_object(g)) * (p - object_location(g));
}

// Where the point was before its mesh was moved; first: of its positions.
vec3 rest_position(Geo g, uint first)
{
    uvec3 corners = triangles[g.triangle].xyz;
    vec3 p[3];
    for (int c = 0; c < 3; c++) {
        uint i = first + 3u * corners[c];
        p[c] = uintBitsToFloat(uvec3(attribute_word(i), attribute_word(i + 1u), attribute_word(i + 2u)));
    }
    return p[0] + g.bary.x * (p[1] - p[0]) + g.bary.y * (p[2] - p[0]);
}

bool is_at_rest(Geo g)
{
    return (g.rays & AT_REST) != 0u && shown[g.instance].rest != NO_REST;
}

// The point itself in object space, metres: from the corners, which is exact.
vec3 position_os(Geo g)
{
    if (!has_object(g))
        return point_to_object(g, g.position);
    if (is_at_rest(g))
        return point_to_object(g, g.position);
    uvec4 corners = triangles[g.triangle];
    vec3 a = vertex_os(corners.x);
    return a + g.bary.x * (vertex_os(corners.y) - a) + g.bary.y * (vertex_os(corners.z) - a);
}

vec3 direction_to_object(Geo g, vec3 v)
{
    return inverse_of(world_from_object(g)) * v;
}

vec3 direction_to_world(Geo g, vec3 v)
{
    return world_from_object(g) * v;
}

// Normals go by inverse transposes and stay unit vectors.
vec3 normal_to_object(Geo g, vec3 n)
{
    return unit_or_zero(transpose(world_from_object(g)) * n);
}

vec3 normal_from_object(Geo g, vec3 n)
{
    return unit_or_zero(transpose(inverse_of(world_from_object(g))) * n);
}

// The same point before its mesh was moved.
Geo at_rest(Geo g)
{
    g.rays |= AT_REST;
    if (has_object(g) && is_at_rest(g))
        g.position = to_world(instances[g.instance], rest_position(g, shown[g.instance].rest)) + u_centre;
    return g;
}

// 0 to 1 in the box of the mesh's own coordinates.
vec3 generated_at(Geo g)
{
    if (!has_object(g))
        return position_os(g);
    Shown s = shown[g.instance];
    vec3 p = s.rest == NO_REST ? position_os(g) : rest_position(g, s.rest);
    return (p - s.low) / mix(s.size, vec3(1.0), equal(s.size, vec3(0.0)));
}
