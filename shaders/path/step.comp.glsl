// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    light that points reflect or let through without spreading it as their ground does, and one leg more of the
//             paths that go on from them through mirrors and glass. What a path meets sends out diffuse light, and goes on with
//             its own mirrors.
// Formula:    L = sum f E_perp w over draws; beta *= f cos / pdf = F G2 / G1 [Heitz18]; paths go on with twice the albedo
// In:         Wave: points, lobes; of what the eye sees draws, of what paths met paths, in List; light cache, BVH, lights
// Out:        Wave: gloss, paths, what they meet; Next: the list of paths that go on, whose order is of no consequence
// Invocation: one point

#include "bind/cache.glsl"
#include "bind/gloss.glsl"
#include "bind/lights.glsl"
#include "bind/list.glsl"
#include "bind/lobes.glsl"

layout(std430) buffer Next { uint next[]; };

uniform uint u_paths;
uniform uint u_met;        // planes of what paths meet
uniform uint u_round;      // vertices behind: 0 for what the eye sees
uniform bool u_is_last;    // whether paths end at these points

// A path that goes on from a point. chance: a random number that decides whether it goes on at what it meets.
struct Path {
    vec3 direction;
    float pdf;         // [sr^-1]
    vec3 beta;
    float chance;
    uint seed;
    bool is_through;   // whether it began through the surface
    float to_surface;  // metres from the eye to where it began
};

void put_path(uint slot, Path p)
{
    put(u_paths, slot, p.direction, p.pdf);
    put(u_paths + 1u, slot, p.beta, p.chance);
    wave[at_plane(u_paths + 2u, slot)] = uvec4(p.seed, uint(p.is_through), floatBitsToUint(p.to_surface), 0u);
}

Path get_path(uint slot)
{
    vec4 a = get(u_paths, slot), b = get(u_paths + 1u, slot);
    uvec4 c = wave[at_plane(u_paths + 2u, slot)];
    return Path(a.xyz, a.w, b.xyz, b.w, c.x, c.y != 0u, uintBitsToFloat(c.z));
}

bool is_vertex()
{
    return u_round > 0u;
}

// Light that draws bring: towards wo, from its own side or from behind; and the irradiance of lamps on its own side.
struct DrawnLight {
    vec3 reflected;
    vec3 transmitted;
    vec3 E;
};

// How many draws light a point. What the eye sees has draws already, with shadows. At a path's vertex one draw serves what is
// diffuse and what is not; if the path ends there, or is smooth, lamps for the ground are all that counts.
struct Draws {
    bool is_wanted;  // for what is not diffuse
    int n_tree;
    int n_side;      // of each side
    int n;
};

Draws draws_of(Point p, bool goes_on, bool has_ground)
{
    bool is_wanted = goes_on && !is_kind(p, POINT_SMOOTH);
    int n_tree = is_wanted ? u_n_tree_draws : min(u_n_tree_draws, 1);
    int n = is_wanted ? n_draws() : is_vertex() && has_ground ? n_lamp_draws(n_tree) : 0;
    return Draws(is_wanted, n_tree, n, is_wanted && is_kind(p, POINT_BENDING) ? 2 * n : n);
}

LightDraw draw_of(Draws draws, int i, Point p, uint slot, out Way way)
{
    LightDraw draw = NO_DRAW;
    way = NO_WAY;
    if (!is_vertex() || (u_n_emitter_draws > 0 && draws.is_wanted))
        draw = get_draw(uint(i), slot);
    if (!is_vertex())
        return draw;
    Surface s = surface_of(p);
    uint seed = p.seed + 3u;
    if (i >= draws.n_side) {
        s = turned_round(s);
        seed = hash(seed);
    }
    return draw_light(i < draws.n_side ? i : i - draws.n_side, draws.n_tree, draw, s, p.number, seed, way);
}

void add_draw(LightDraw draw, Draws draws, int i, Point p, Bsdf b, vec3 wo, mat3 frame, inout DrawnLight light)
{
    if (draw.E_perp == vec3(0.0))
        return;
    if (i < n_lamp_draws(draws.n_tree))
        light.E += max(dot(p.normal, draw.wi), 0.0) * draw.E_perp;
    if (!draws.is_wanted)
        return;
    float pdf;
    vec3 f = evaluate_specular(b, wo, draw.wi * frame, pdf);
    vec3 L = f * draw.E_perp * balance(draw.pdf, pdf);
    light.reflected += i < draws.n_side ? L : vec3(0.0);
    light.transmitted += i < draws.n_side ? vec3(0.0) : L;
}

// All that arrives at what a path along d met, but for lamps.
vec3 bounced(Point p, vec3 d)
{
    uint side = cache_side(p.position, p.normal_geometric, is_kind(p, POINT_TURNED) ? -d : d);
    return side == NOTHING ? vec3(0.0) : cache[cache_entry(INDIRECT, side)].rgb;
}

// Light that a path finds where it has come to; false if it ends there. ending: what reflects light from everywhere.
bool arrive(Point p, uint slot, vec3 glossy, inout Path path, out vec3 ending)
{
    ending = vec3(0.0);
    if (u_round == 1u && !path.is_through) {
        vec4 sum = get(u_gloss + GLOSSY_DIRECT_PLANE, slot);
        put(u_gloss + GLOSSY_DIRECT_PLANE, slot, sum.xyz, p.t / max(path.to_surface + p.t, 1e-9));
    }
    if (!is_kind(p, POINT_SURFACE))
        return false;
    bool has_lobes = is_kind(p, POINT_LOBES), ends = u_is_last || is_kind(p, POINT_ROUGH);
    add_gloss(slot, path.is_through, u_round == 1u, path.beta * p.emission * p.weight);
    ending = path.beta / PI * (p.diffuse + (has_lobes && ends ? glossy : vec3(0.0)));
    return has_lobes && !ends && path.chance < p.chance;
}

// The frame whose first axis is the tangent.
mat3 turned_frame(mat3 frame, float turn)
{
    if (turn == 0.0)
        return frame;
    vec2 t = vec2(cos(turn), sin(turn));
    return mat3(t.x * frame[0] + t.y * frame[1], t.x * frame[1] - t.y * frame[0], frame[2]);
}

// Choose a way on; false if there is none.
bool scatter(Point p, Bsdf b, vec3 wo, mat3 frame, inout Path path)
{
    vec2 chances = sobol_point(p.number, path.seed + 1u);
    Drawn drawn = sample_specular(b, wo, sobol_point(p.number, path.seed + 2u), chances.x);
    path.direction = frame * drawn.wi;
    path.pdf = drawn.pdf;
    path.beta *= drawn.weight;
    path.chance = chances.y;
    if (!is_vertex())
        path.is_through = drawn.is_through;
    return path.beta != vec3(0.0) && (dot(path.direction, p.normal_geometric) < 0.0) == drawn.is_through;
}

// The next leg: what it met, and the lamps and the world that it found on the way.
void follow(Point p, Path path, bool is_hit, Crossing c, uint slot)
{
    vec3 d = path.direction, L = lamps_on_ray(surface_of(p), d, c.t, path.pdf);
    if (!is_hit)
        L += world_radiance(d, 0.0) * world_weight(d, path.pdf);
    add_gloss(slot, path.is_through, !is_vertex(), path.beta * L);
    put_path(slot, path);
    put_hit(u_met, slot, Hit(c.instance, c.triangle, c.bary, d, c.t, p.number, hash(path.seed), path.pdf, 1.0));
    next[LIST_HEAD + atomicAdd(next[0], 1u)] = slot;
}

// All draws are done: what they bring, and the way on. ending: what of it reflects light from everywhere.
Way way_on(Point p, DrawnLight light, Bsdf b, vec3 wo, mat3 frame, vec3 ending, bool goes_on, uint slot, inout Path path)
{
    if (ending != vec3(0.0))
        add_gloss(slot, path.is_through, false, ending * (light.E + bounced(p, path.direction)));
    if (!goes_on)
        return NO_WAY;
    if (is_vertex()) {
        path.beta /= p.chance;
        add_gloss(slot, path.is_through, false, path.beta * (light.reflected + light.transmitted));
    } else {
        put_gloss(slot, Gloss(light.reflected, 0.0, vec3(0.0), light.transmitted, vec3(0.0)));
    }
    if (!scatter(p, b, wo, frame, path))
        return NO_WAY;
    vec3 o = offset_origin(p.position, p.normal_geometric, path.direction);
    return Way(o, path.direction, INFINITE, hash(path.seed + p.number), false);
}

// What is known while a point is lit and its path goes on.
struct Vertex {
    Point p;
    Bsdf b;
    vec3 wo;       // in the frame
    mat3 frame;
    bool goes_on;
    vec3 ending;   // what reflects light from everywhere, if the path ends here with some
    Draws draws;
    DrawnLight light;
    Path path;
};

// Trace one ray: for the shadow of draw i, or, which is_draw denies, for the next leg.
void trace_one(bool is_draw, int i, uint slot, inout Vertex v)
{
    Way way;
    Crossing c;
    LightDraw draw = NO_DRAW;
    if (is_draw)
        draw = draw_of(v.draws, i, v.p, slot, way);
    else
        way = way_on(v.p, v.light, v.b, v.wo, v.frame, v.ending, v.goes_on, slot, v.path);
    bool is_hit = trace(way, c);
    if (is_draw && !is_hit)
        add_draw(draw, v.draws, i, v.p, v.b, v.wo, v.frame, v.light);
    else if (!is_draw && way.t_max > 0.0)
        follow(v.p, v.path, is_hit, c, slot);
}

// Light the point, then go on: all rays are traced at one place, but in lockstep, as in gather/rays.
void go_on(uint slot)
{
    Vertex v;
    v.p = get_point(u_set, slot);
    v.path = Path(vec3(0.0), 0.0, vec3(1.0), 0.0, hash(v.p.seed + 3u), false, v.p.t);
    v.b = get_lobes(u_set, slot);
    v.goes_on = is_kind(v.p, POINT_LOBES);
    v.ending = vec3(0.0);
    if (is_vertex()) {
        v.path = get_path(slot);
        v.path.seed = v.p.seed;
        v.goes_on = arrive(v.p, slot, v.b.glossy, v.path, v.ending);
    }
    v.frame = turned_frame(frame_of(v.p.normal), v.b.turn);
    v.wo = -get(u_set + 1u, slot).xyz * v.frame;
    v.draws = draws_of(v.p, v.goes_on, v.ending != vec3(0.0));
    v.light = DrawnLight(vec3(0.0), vec3(0.0), vec3(0.0));
    int n = v.draws.n;
    if (IN_LOCKSTEP) {
        for (int i = 0; i < n; i++)
            trace_one(true, i, slot, v);
        trace_one(false, n, slot, v);
    } else {
        for (int i = 0; i <= n; i++)
            trace_one(i < n, i, slot, v);
    }
}

void main()
{
    for (uint i = u_first + gl_GlobalInvocationID.x; i < n_slots(); i += u_step)
        go_on(slot_of(i));
}
