// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    outlines: pixels whose neighbours, half a line's thickness away, belong to another object or material, lie
//             beyond an edge, or in front of or behind what is seen.
// In:         Wave: hits; camera, BVH, triangles, tiles that are done
// Out:        Wave: points that send out the lines' colour and reflect nothing
// Invocation: one pixel

#include "bind/trace.glsl"
#include "bind/vertices.glsl"
#include "raster/eye.glsl"

uniform float u_depth;          // from the near to the far plane, in lengths of the direction that u_ray_direction gives
uniform float u_reach;          // half the thickness, in pixels
uniform vec3 u_color;
uniform float u_crease;         // cosine of the angle between two faces from which their edge is drawn; -2 for no edge
uniform bool u_silhouettes;
uniform bool u_materials;
uniform bool u_objects;

const float GAP = 0.05;  // of the distance: what lies farther behind its neighbour is behind its outline

bool has_surface(Hit hit)
{
    return hit.instance < HIT_DONE;
}

// What the eye sees `offset` pixels beside the middle of a pixel.
Hit seen_beside(ivec2 pixel, vec2 offset)
{
    vec3 at = clip_position(vec2(pixel) + 0.5 + offset), d = u_ray_direction * at;
    Crossing c;
    trace_closest(u_ray_origin * at, d, u_depth, 0u, c);
    return Hit(c.instance, c.triangle, c.bary, normalize(d), c.t * length(d), 0u, 0u, 0.0, 0.0);
}

vec3 position_of(ivec2 pixel, vec2 offset, Hit hit)
{
    return u_ray_origin * clip_position(vec2(pixel) + 0.5 + offset) + hit.t * hit.direction;
}

// Whether one of two surfaces lies well behind the plane of the other.
bool is_apart(vec3 p, vec3 n, vec3 from, Hit other)
{
    float towards = dot(n, other.direction);
    float expected = abs(towards) > 1e-3 ? dot(n, p - from) / towards : other.t;
    return abs(other.t - expected) > GAP * other.t;
}

bool is_line(ivec2 pixel, vec2 offset, Hit own, Hit other)
{
    if (has_surface(own) != has_surface(other))
        return u_silhouettes || u_objects;
    if (!has_surface(own))
        return false;
    if (own.instance != other.instance && u_objects)
        return true;
    if (u_materials && material_of(own.instance, own.triangle) != material_of(other.instance, other.triangle))
        return true;
    vec3 n = normalize(normal_of(own.instance, own.triangle)), m = normalize(normal_of(other.instance, other.triangle));
    if (own.instance == other.instance && dot(n, m) < u_crease)
        return true;
    vec3 p = position_of(pixel, vec2(0.0), own), q = position_of(pixel, offset, other);
    return u_silhouettes && is_apart(p, n, q - other.t * other.direction, other) && is_apart(q, m, p - own.t * own.direction, own);
}

void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x;
    if (slot >= u_end)
        return;
    ivec2 pixel = pixel_of(slot);
    if (is_outside(pixel) || is_done(pixel))
        return;
    Hit own = get_hit(u_set, slot), nearest = own;
    bool is_drawn = false;
    for (int i = 0; i < 4; i++) {
        vec2 offset = u_reach * (i < 2 ? vec2(2 * i - 1, 0) : vec2(0, 2 * i - 5));
        Hit other = seen_beside(pixel, offset);
        if (!is_line(pixel, offset, own, other))
            continue;
        is_drawn = true;
        if (has_surface(other) && (!has_surface(nearest) || other.t < nearest.t))
            nearest = other;
    }
    if (!is_drawn)
        return;
    vec3 towards = -own.direction, none = vec3(0.0);
    put_point(u_set, slot, Point(POINT_SURFACE, position_of(pixel, vec2(0.0), nearest), own.number, towards, own.seed, towards,
                                 nearest.t, none, 0.0, none, 1.0, u_color));
    put_no_hit(u_set, slot, BVH_NONE);  // no material has a say in it
}
