// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: Normal Map, Bump, the displacements.

#include "bind/attributes.glsl"
#include "nodes/bounded.glsl"

// A map of tangent space; tangents: their number.
vec3 normal_map_tangent(Geo g, vec3 color, float strength, uint tangents)
{
    Attribute a = attribute_of(g, tangents);
    if (a.width == 0u)
        return g.normal;
    vec3 weights = vec3(1.0 - g.bary.x - g.bary.y, g.bary), smooth_os = vec3(0.0), map = 2.0 * color - 1.0;
    for (uint i = 0u; i < 3u; i++)
        smooth_os += weights[i] * unpack_unit(corner_normals[3u * g.triangle + i]);
    map = vec3(map.xy * strength, mix(1.0, map.z, clamp(strength, 0.0, 1.0)));
    vec3 across = sign(a.value.w) * cross(smooth_os, a.value.xyz);
    vec3 n = normal_from_object(g, unit_or_zero(map.x * a.value.xyz + map.y * across + map.z * smooth_os));
    return n == vec3(0.0) ? g.normal : g.is_back ? -n : n;
}

// Maps of object or world space; is_old: with y and z as Blender's own renderer once had them.
vec3 normal_map_space(Geo g, vec3 color, float strength, bool is_of_object, bool is_old)
{
    vec3 n = 2.0 * color - 1.0;
    n.yz *= is_old ? -1.0 : 1.0;
    n = is_of_object ? normal_from_object(g, n) : unit_or_zero(n);
    n = g.is_back ? -n : n;
    if (strength != 1.0)
        n = unit_or_zero(g.normal + (n - g.normal) * max(strength, 0.0));
    return n == vec3(0.0) ? g.normal : n;
}

// The change of position by the width of a pixel, in the two directions of g.dx and g.dy.
mat2x3 footprint(Geo g)
{
    vec3 ab = edge(g.instance, g.triangle, 1u), ac = edge(g.instance, g.triangle, 2u);
    return mat2x3(g.dx.x * ab + g.dx.y * ac, g.dy.x * ab + g.dy.y * ac);
}

// The normal of a surface that is lifted along `normal`: by h here, by hx and hy `width` of the steps dx and dy away.
vec3 lifted_normal(vec3 dx, vec3 dy, float h, float hx, float hy, vec3 normal, float strength, float distance, float width)
{
    vec3 rx = cross(dy, normal), ry = cross(normal, dx);
    float det = dot(dx, rx);
    vec3 gradient = ((hx - h) * rx + (hy - h) * ry) * distance;
    // By the size of the pixel, so that squares of small ones stay in range
    vec3 n = width * abs(det) * normal - sign(det) * gradient;
    float largest = max(abs(n.x), max(abs(n.y), abs(n.z)));
    if (!(largest > 0.0) || isinf(largest))
        return normal;
    float s = max(strength, 0.0);
    n = unit_or_zero(s * normalize(n / largest) + (1.0 - s) * normal);
    return n == vec3(0.0) ? normal : n;
}

// Heights in metres.
vec3 bumped_normal(Geo g, float h, float hx, float hy, vec3 normal, float strength, float distance, float width)
{
    if (!has_object(g))
        return normal;
    mat2x3 d = footprint(g);
    return lifted_normal(d[0], d[1], h, hx, hy, normal, strength, distance, width);
}

// As footprint, in object space and before the mesh was moved.
mat2x3 rest_footprint(Geo g, uint first)
{
    Geo x = g, y = g;
    x.bary += g.dx;
    y.bary += g.dy;
    vec3 p = rest_position(g, first);
    return mat2x3(rest_position(x, first) - p, rest_position(y, first) - p);
}

// The same in object space: heights grow with the object.
vec3 bumped_normal_of_object(Geo g, float h, float hx, float hy, vec3 normal, float strength, float distance, float width)
{
    if (!has_object(g))
        return normal;
    mat2x3 d = is_at_rest(g) ? rest_footprint(g, shown[g.instance].rest) : footprint(g);
    vec3 n = normal_to_object(g, normal);
    vec3 dx = is_at_rest(g) ? d[0] : direction_to_object(g, d[0]), dy = is_at_rest(g) ? d[1] : direction_to_object(g, d[1]);
    return normal_from_object(g, lifted_normal(dx, dy, h, hx, hy, n, strength, distance, width));
}

float height_along(vec3 by, vec3 normal)
{
    return dot(by, normal);
}

// Along the normal; in the object's space it goes through the object's scale.
vec3 displaced(Geo g, float height, float midlevel, float scale, vec3 normal, bool is_of_object)
{
    float by = bounded((height - midlevel) * scale);
    return bounded3(is_of_object ? direction_to_world(g, normal_to_object(g, normal) * by) : normal * by);
}

vec3 displaced_by_vector(Geo g, vec3 by, float midlevel, float scale, bool is_of_object)
{
    vec3 v = bounded3((by - midlevel) * scale);
    return is_of_object ? bounded3(direction_to_world(g, v)) : v;
}

// by: along u, along the normal, along v.
vec3 displaced_in_tangent_space(Geo g, vec3 by, float midlevel, float scale, uint tangents)
{
    vec3 v = bounded3((by - midlevel) * scale), n = normal_to_object(g, g.normal);
    Attribute a = attribute_of(g, tangents);
    vec3 t = a.width > 0u ? a.value.xyz : frame_of(n)[0];
    t -= n * dot(n, t);  // g.normal does not turn where a bump looks beside g, and tangents must not lean out of its plane
    vec3 b = unit_or_zero(cross(n, t)) * (a.width > 0u ? sign(a.value.w) : 1.0);
    return bounded3(direction_to_world(g, t * v.x + n * v.y + b * v.z));
}
