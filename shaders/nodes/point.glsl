// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: outputs of Geometry, Tangent, Wireframe, Light Path.

#include "bind/attributes.glsl"
#include "bind/material_rows.glsl"

vec3 position_of_point(Geo g)
{
    return g.position;
}

vec3 true_normal_of_point(Geo g)
{
    return g.normal_geometric;
}

vec3 incoming_of_point(Geo g)
{
    return g.wo;
}

vec3 parametric_of_point(Geo g)
{
    return vec3(1.0 - g.bary.x - g.bary.y, g.bary.x, 0.0);
}

float backfacing_of_point(Geo g)
{
    return g.is_back ? 1.0 : 0.0;
}

// A direction in object space, laid into the plane of the shading normal.
vec3 laid_tangent(Geo g, vec3 along_os)
{
    return cross(g.normal, unit_or_zero(cross(normal_from_object(g, along_os), g.normal)));
}

// Around an axis through the middle of the box of generated coordinates: 0, 1, 2 for x, y, z.
vec3 radial_tangent(Geo g, int axis)
{
    vec3 p = generated_at(g) - 0.5;
    return laid_tangent(g, axis == 0 ? vec3(0.0, -p.z, p.y) : axis == 1 ? vec3(-p.z, 0.0, p.x) : vec3(-p.y, p.x, 0.0));
}

// Along u of a UV map, by the number of its tangents.
vec3 uv_tangent(Geo g, uint tangents)
{
    Attribute a = attribute_of(g, tangents);
    return a.width > 0u ? laid_tangent(g, a.value.xyz) : vec3(0.0);
}

// 1 within half of `size` of an edge; size in metres or in pixels.
float wireframe(Geo g, float size, bool is_in_pixels)
{
    if (!has_object(g))
        return 0.0;
    uvec4 corners = triangles[g.triangle];
    vec3 p[3] = vec3[3](vertex_ws(g.instance, corners.x), vertex_ws(g.instance, corners.y), vertex_ws(g.instance, corners.z));
    vec3 ab = p[1] - p[0], ac = p[2] - p[0], at = g.position - u_centre;
    vec3 dx = g.dx.x * ab + g.dx.y * ac, dy = g.dy.x * ab + g.dy.y * ac;
    float pixel = 0.5 * (length(dx - dot(dx, g.wo) * g.wo) + length(dy - dot(dy, g.wo) * g.wo));
    float half_width = 0.5 * size * (is_in_pixels ? pixel : 1.0);
    for (int i = 0; i < 3; i++) {
        vec3 away = cross(at - p[i], unit_or_zero(p[i] - p[(i + 2) % 3]));
        if (dot(away, away) < half_width * half_width)
            return 1.0;
    }
    return 0.0;
}

float material_number(Geo g)
{
    return has_object(g) ? float(materials[material_of(g.instance, g.triangle)].pass_index) : 0.0;
}

float is_ray(Geo g, uint bits)
{
    return (g.rays & bits) != 0u ? 1.0 : 0.0;
}

float ray_length(Geo g)
{
    return g.t;
}

float ray_depth(Geo g)
{
    return float(g.depth);
}

// Bounces of one kind are known of the last one alone.
float ray_depth_of(Geo g, uint bits)
{
    return (g.rays & bits) != 0u ? float(g.depth) : 0.0;
}
