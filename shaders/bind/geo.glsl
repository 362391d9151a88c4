// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a node tree sees of the point at which it is evaluated.

#include "bind/geometry.glsl"

layout(std430) readonly buffer Values { uint values[]; };  // of all materials: bits of floats, and indices

uniform vec3 u_centre;      // world, metres: what positions on the device are relative to
uniform vec2 u_footprint;   // width of a pixel: metres, and metres for each metre of the ray

const uint AT_REST = 0x80000000u;  // among g.rays: positions are those before the mesh was moved

struct Geo {
    uint instance;
    uint triangle;
    vec2 bary;               // of the second and third corner
    vec3 position;           // world, metres
    vec3 normal;             // unit, shading normal on wo's side, before any normal map
    vec3 normal_geometric;   // unit, the triangle's, on wo's side
    vec3 wo;                 // unit, towards where the point is seen from
    bool is_back;            // seen from behind
    float t;                 // metres of the ray
    uint rays;               // bits RAY_*: which kind of ray has come here
    uint depth;              // bounces behind
    uint first_value;        // of the material
    vec2 dx;                 // how bary changes by the width of a pixel, in two directions at right angles
    vec2 dy;
};

float value_at(Geo g, uint i)
{
    return uintBitsToFloat(values[g.first_value + i]);
}

vec3 value3_at(Geo g, uint i)
{
    return vec3(value_at(g, i), value_at(g, i + 1u), value_at(g, i + 2u));
}

uint index_at(Geo g, uint i)
{
    return values[g.first_value + i];
}

vec3 edge(uint instance, uint triangle, uint corner)
{
    uvec4 corners = triangles[triangle];
    return vertex_ws(instance, corners[corner]) - vertex_ws(instance, corners.x);
}

// The change of barycentrics that goes along v in the triangle's plane.
vec2 bary_of(vec3 v, vec3 ab, vec3 ac)
{
    float aa = dot(ab, ab), bb = dot(ac, ac), m = dot(ab, ac), va = dot(v, ab), vb = dot(v, ac), det = aa * bb - m * m;
    return det > 0.0 ? vec2(bb * va - m * vb, aa * vb - m * va) / det : vec2(0.0);
}

// Two directions that with the unit vector n are orthonormal, as Cycles chooses them: differences are taken along these.
mat2x3 across(vec3 n)
{
    vec3 x = n.x != n.y || n.x != n.z ? vec3(n.z - n.y, n.x - n.z, n.y - n.x) : vec3(n.z - n.y, n.x + n.z, -n.y - n.x);
    x = normalize(x);
    return mat2x3(x, cross(n, x));
}

// The point `hit` that is seen along -wo.
Geo geo_at(Seen seen, uint instance, uint triangle, vec2 bary, vec3 wo, float t, uint rays, uint depth, uint first_value)
{
    vec3 ab = edge(instance, triangle, 1u), ac = edge(instance, triangle, 2u), n = seen.surface.normal_geometric;
    float width = u_footprint.x + u_footprint.y * t;
    mat2x3 xy = across(n);
    return Geo(instance, triangle, bary, seen.surface.position + u_centre, seen.surface.normal, n, wo, seen.is_back, t, rays,
               depth, first_value, width * bary_of(xy[0], ab, ac), width * bary_of(xy[1], ab, ac));
}

// The point that is seen `width` pixels away, along x (axis 0) or y of the picture.
Geo shifted(Geo g, int axis, float width)
{
    vec2 by = width * (axis == 0 ? g.dx : g.dy);
    g.bary += by;
    if ((g.rays & AT_REST) != 0u) {  // along the moved surface, as Cycles does it
        g.position += width * (u_footprint.x + u_footprint.y * g.t) * across(g.normal_geometric)[axis];
        return g;
    }
    g.position += by.x * edge(g.instance, g.triangle, 1u) + by.y * edge(g.instance, g.triangle, 2u);
    return g;
}
