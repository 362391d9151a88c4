// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what passes hand on for the pixels of one part of the picture, in planes: a plane has 16 bytes for each slot, a
// pixel's place in its part, so that neighbours read and write neighbouring words. The host says where planes lie.

#include "lib/layouts.glsl"
#include "lib/light_draw.glsl"
#include "lib/surface.glsl"

layout(std430) buffer Wave { uvec4 wave[]; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_stride;   // slots of a plane
uniform uint u_set;      // planes of the points at hand, what the eye sees or what paths met: hits, points, lobes
uniform uint u_arrivals;
uniform uint u_draws;

// What a ray along unit `direction` met after t metres: BVH_NONE as instance for nothing, HIT_DONE for a pixel that needs no
// more light. number, seed: of the ray's random numbers. pdf [sr^-1]: with which it was drawn; weight: of the emission that
// it finds.
struct Hit {
    uint instance;
    uint triangle;
    vec2 bary;
    vec3 direction;
    float t;
    uint number;
    uint seed;
    float pdf;
    float weight;
};

// What a hit looks like: no trace of a material is left in it. POINT_TURNED: light shines through from behind, so both normals
// point away from wo. POINT_HOLDOUT: a hole in the picture. POINT_SHAPED: the ground is none of Lambert's, see bind/shapes.glsl.
struct Point {
    uint kind;      // bits POINT_*
    vec3 position;
    uint number;
    vec3 normal;
    uint seed;
    vec3 normal_geometric;
    float t;
    vec3 diffuse;   // albedo of what is diffuse
    float chance;   // with which a path goes on from here
    vec3 lift;
    float weight;   // of the emission, which draws may find as well
    vec3 emission;  // radiance
};

// Irradiance [W m^-2]: drawn; all else; the part of that which rays met at emitters or in the world.
struct Arrival {
    vec3 direct;
    vec3 indirect;
    vec3 found;
};

uint at_plane(uint plane, uint slot)
{
    return plane * u_stride + slot;
}

void put(uint plane, uint slot, vec3 xyz, float w)
{
    wave[at_plane(plane, slot)] = floatBitsToUint(vec4(xyz, w));
}

void put(uint plane, uint slot, vec3 xyz, uint w)
{
    wave[at_plane(plane, slot)] = uvec4(floatBitsToUint(xyz), w);
}

vec4 get(uint plane, uint slot)
{
    return uintBitsToFloat(wave[at_plane(plane, slot)]);
}

uint get_word(uint plane, uint slot)
{
    return wave[at_plane(plane, slot)].w;
}

void put_hit(uint set, uint slot, Hit h)
{
    wave[at_plane(set, slot)] = uvec4(h.instance, h.triangle, floatBitsToUint(h.bary));
    put(set + 1u, slot, h.direction, h.t);
    wave[at_plane(set + 2u, slot)] = uvec4(h.number, h.seed, floatBitsToUint(vec2(h.pdf, h.weight)));
}

void put_no_hit(uint set, uint slot, uint why)
{
    wave[at_plane(set, slot)] = uvec4(why, 0u, 0u, 0u);
}

Hit get_hit(uint set, uint slot)
{
    uvec4 a = wave[at_plane(set, slot)], c = wave[at_plane(set + 2u, slot)];
    vec4 b = get(set + 1u, slot);
    return Hit(a.x, a.y, uintBitsToFloat(a.zw), b.xyz, b.w, c.x, c.y, uintBitsToFloat(c.z), uintBitsToFloat(c.w));
}

// Planes that hold nothing but zeros are not written: most surfaces are flat and dark.
void put_point(uint set, uint slot, Point p)
{
    uint at = set + HIT_PLANES;
    bool is_lifted = p.lift != vec3(0.0) || p.chance != 0.0, glows = p.emission != vec3(0.0);
    put(at, slot, p.position, p.kind | (is_lifted ? POINT_LIFTED : 0u) | (glows ? POINT_GLOWS : 0u));
    put(at + 1u, slot, p.normal, p.number);
    put(at + 2u, slot, p.normal_geometric, p.seed);
    put(at + 3u, slot, p.diffuse, p.t);
    if (is_lifted)
        put(at + 4u, slot, p.lift, p.chance);
    if (glows)
        put(at + 5u, slot, p.emission, p.weight);
}

Point get_point(uint set, uint slot)
{
    uint at = set + HIT_PLANES, kind = get_word(at, slot);
    vec4 d = get(at + 3u, slot), e = vec4(0.0), f = vec4(0.0);
    if ((kind & POINT_LIFTED) != 0u)
        e = get(at + 4u, slot);
    if ((kind & POINT_GLOWS) != 0u)
        f = get(at + 5u, slot);
    return Point(kind, get(at, slot).xyz, get_word(at + 1u, slot), get(at + 1u, slot).xyz, get_word(at + 2u, slot),
                 get(at + 2u, slot).xyz, d.w, d.xyz, e.w, e.xyz, f.w, f.xyz);
}

bool is_kind(Point p, uint kinds)
{
    return (p.kind & kinds) != 0u;
}

Surface surface_of(Point p)
{
    return Surface(p.position, p.normal_geometric, p.normal, p.lift);
}

void put_arrival(uint slot, Arrival a)
{
    put(u_arrivals, slot, a.direct, 0.0);
    put(u_arrivals + 1u, slot, a.indirect, 0.0);
    put(u_arrivals + 2u, slot, a.found, 0.0);
}

Arrival get_arrival(uint slot)
{
    return Arrival(get(u_arrivals, slot).xyz, get(u_arrivals + 1u, slot).xyz, get(u_arrivals + 2u, slot).xyz);
}

void put_draw(uint i, uint slot, LightDraw draw)
{
    put(u_draws + DRAW_PLANES * i, slot, draw.wi, draw.distance);
    put(u_draws + DRAW_PLANES * i + 1u, slot, draw.E_perp, draw.pdf);
}

LightDraw get_draw(uint i, uint slot)
{
    vec4 a = get(u_draws + DRAW_PLANES * i, slot), b = get(u_draws + DRAW_PLANES * i + 1u, slot);
    return LightDraw(a.xyz, a.w, b.xyz, b.w);
}
