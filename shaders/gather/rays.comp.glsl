// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the light that arrives at what the eye sees, by rays with exact hits: lamps, emitters and the world drawn, with
//             traced shadows; diffuse rays, distributed as the cosine, end in surfels of the light cache. What draws and rays
//             both find is weighed by the balance heuristic [Veach95].
// Formula:    E = sum_k E_k max(cos_k, 0) w_k + pi / N sum L(w_i), L = rho / pi (E_lamps + E_indirect); each times f pi / rho
//             where the ground is none of Lambert's
// In:         Wave: points, draws of emitters; light cache, BVH, triangles, lights, world
// Out:        Wave: arrivals; what rays met, if anything shines; draws with shadows, if reflections need them
// Invocation: one pixel

#include "bind/cache.glsl"
#include "bind/geometry.glsl"
#include "bind/lights.glsl"
#include "bind/shapes.glsl"

const float CLOSE = 8.0;  // voxels up to which a diffuse ray sees all that it meets lit exactly

uniform int u_n_rays;          // diffuse ones
uniform int u_n_facing;        // 2 if light from behind shines through any point
uniform bool u_keeps_draws;
uniform bool u_keeps_ends;
uniform uint u_ends;           // planes of what diffuse rays met: one each

// What a pixel or the end of one of its diffuse rays is lit by, and how much of that counts.
struct Place {
    Surface surface;
    uint seed;
    int n_tree;     // draws of the lamps' tree
    bool is_eye;    // else lamps alone are drawn, since the cache holds all else
    vec3 weight;    // of the irradiance that is drawn
};

// Share of draw k in the irradiance: diffuse rays of the eye find emitters and the world too, but no lamps.
vec3 irradiance_of(LightDraw draw, int k, Place at)
{
    float NoL = max(dot(at.surface.normal, draw.wi), 0.0);
    float pdf_rays = at.is_eye && k >= n_lamp_draws(at.n_tree) ? float(u_n_rays) * NoL / PI : 0.0;
    return NoL * balance(draw.pdf, pdf_rays) * draw.E_perp;
}

// The end of a diffuse ray: its colour and all that bounces from its side in the cache. Lamps light it exactly, as its own
// normals say, where it is near. Far away the edges of shadows may be a voxel wide, so lamps are taken from the cache too; but
// not those of a tree, of which it holds a few draws: their noise would stay. L: what needs no draws.
Place end_of(Crossing c, Way way, uint seed, out vec3 L)
{
    Place at = Place(Surface(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0)), seed, 1, false, vec3(0.0));
    L = vec3(0.0);
    uint side = cache_side(way.o + c.t * way.d, normal_of(c.instance, c.triangle), way.d);
    if (side == NOTHING)
        return at;
    vec4 sent = cache[cache_entry(SENT, side)], lamps = cache[cache_entry(LAMPS, side)];
    vec3 reflected = albedo_from(vec2(sent.w, lamps.w)) / PI;
    L = sent.rgb;
    if (u_n_tree_draws == 0 && c.t * u_voxels_per_metre > CLOSE) {
        L += reflected * lamps.rgb;
    } else {
        at.surface = seen_at(c.instance, c.triangle, c.bary, -way.d).surface;
        at.surface.normal = facing(at.surface.normal, -way.d);
        at.weight = reflected;
    }
    return at;
}

LightDraw draw_at(Place at, int i, Point p, uint slot, out Way way)
{
    int k = i;
    LightDraw emitter = NO_DRAW;
    if (at.is_eye) {
        if (u_n_emitter_draws > 0)
            emitter = get_draw(uint(i), slot);
        if (i >= n_draws()) {
            k = i - n_draws();
            at.surface = turned_round(at.surface);
            at.seed = hash(at.seed);
        }
    }
    return draw_light(k, at.n_tree, emitter, at.surface, p.number, at.seed, way);
}

vec3 direction_of(Point p, int k)
{
    vec3 local = cosine_direction(sobol_point(p.number * uint(u_n_rays) + uint(k), p.seed));
    return frame_of(p.normal) * local;
}

Way diffuse_way(Point p, int k)
{
    vec3 d = direction_of(p, k);
    if (dot(d, p.normal_geometric) <= 0.0)
        return NO_WAY;
    vec3 o = offset_origin(p.position, p.normal_geometric, d);
    return Way(o, d, INFINITE, hash(hash(p.seed + uint(k) + 1u) + p.number), false);
}

// What diffuse ray k brings, but for lamps near its end, where the path of light goes on.
Place end_of_ray(Point p, int k, Way way, bool is_hit, Crossing c, uint slot, inout Arrival a)
{
    Place at = Place(surface_of(p), 0u, 0, false, vec3(0.0));
    if (u_keeps_ends)
        wave[at_plane(u_ends + uint(k), slot)] = uvec4(c.instance, c.triangle, floatBitsToUint(c.bary));
    vec3 L = vec3(0.0);
    if (is_hit)
        at = end_of(c, way, hash(p.seed + uint(k) + 1u), L);
    vec3 share = ground_factor(p, slot, way.d);
    if (!is_hit && way.t_max > 0.0)
        a.found += share * world_radiance(way.d, 0.0) * world_weight(way.d, float(u_n_rays) * dot(p.normal, way.d) / PI);
    a.indirect += share * L;
    at.weight *= share;
    return at;
}

// What is known while a pixel is lit: its point, the place that is lit, and the sum.
struct Lighting {
    Point p;
    int n_sides;  // from which the point is lit
    Place at;
    Arrival sum;
};

// Trace one ray: diffuse ray k, which is_ray says, or for the shadow of draw i at the place that is_first says is the point.
void go_on(bool is_ray, bool is_first, int k, int i, uint slot, inout Lighting l)
{
    Way way = NO_WAY;
    Crossing c;
    LightDraw draw = NO_DRAW;
    if (is_ray)
        way = diffuse_way(l.p, k);
    else if (l.at.weight != vec3(0.0) && i < (is_first ? l.n_sides * n_draws() : n_lamp_draws(l.at.n_tree)))
        draw = draw_at(l.at, i, l.p, slot, way);
    bool is_hit = trace(way, c);
    if (is_ray) {
        l.at = end_of_ray(l.p, k, way, is_hit, c, slot, l.sum);
        return;
    }
    draw.E_perp *= is_hit ? 0.0 : 1.0;
    if (u_keeps_draws && is_first && i < l.n_sides * n_draws())
        put_draw(uint(i), slot, draw);
    vec3 E = l.at.weight * irradiance_of(draw, i, l.at);
    if (is_first)
        E *= ground_factor(l.p, slot, draw.wi);
    l.sum.direct += is_first && i < n_draws() ? E : vec3(0.0);
    l.sum.indirect += is_first ? vec3(0.0) : E;
}

// First the point itself is lit, then diffuse rays are followed one after another and their ends lit. Steps are the same ones
// for all invocations, so that neighbours trace rays of one kind together; who needs none waits. All rays are traced at one
// place: each more takes compilers time, more than in proportion. But in lockstep each step would do the work of both kinds,
// so there they have loops of their own.
void main()
{
    uint slot = u_first + gl_GlobalInvocationID.x;
    if (slot >= u_end)
        return;
    Point p = get_point(u_set, slot);
    if (!is_kind(p, POINT_SURFACE))
        return;
    Lighting l = Lighting(p, is_kind(p, POINT_BENDING) && !is_kind(p, POINT_SMOOTH) ? 2 : 1,
                          Place(surface_of(p), p.seed, u_n_tree_draws, true, vec3(1.0)),
                          Arrival(vec3(0.0), vec3(0.0), vec3(0.0)));
    int n_first = n_draws() * u_n_facing, n_of_ray = 1 + n_lamp_draws(1);
    if (IN_LOCKSTEP) {
        for (int i = 0; i < n_first; i++)
            go_on(false, true, 0, i, slot, l);
        for (int k = 0; k < u_n_rays; k++) {
            go_on(true, false, k, 0, slot, l);
            for (int i = 0; i < n_of_ray - 1; i++)
                go_on(false, false, k, i, slot, l);
        }
    } else {
        for (int step = 0; step < n_first + u_n_rays * n_of_ray; step++) {
            bool is_first = step < n_first;
            int of_ray = (step - n_first) % n_of_ray;
            go_on(!is_first && of_ray == 0, is_first, (step - n_first) / n_of_ray, is_first ? step : of_ray - 1, slot, l);
        }
    }
    if (u_n_rays > 0) {
        l.sum.found *= PI / float(u_n_rays);
        l.sum.indirect = l.sum.indirect * (PI / float(u_n_rays)) + l.sum.found;
    }
    put_arrival(slot, l.sum);
}
