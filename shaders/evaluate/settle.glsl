// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: from the closures of a tree to the point that programs that trace know, and to what light sees of it that was spread.

#include "bind/shapes.glsl"
#include "evaluate/hit.glsl"
#include "evaluate/shaded.glsl"
#include "nodes/closures.glsl"

const uint SETTLE_SEED = 0x5e771e;
const float LEAST = 1e-4;  // share of light that may be lost

// The random number that closures are chosen by.
float closure_chance(Hit hit)
{
    return sobol_point(hit.number, hash(hit.seed ^ SETTLE_SEED)).x;
}

// Fill in what light that was spread sees of a surface: albedo and emission of the part that stops it; in chance,
// how much that is, and in t, which share of the albedo is that of light that goes through.
void put_look(uint slot, Hit hit, Surface s, Closures c)
{
    float opacity = clamp(1.0 - mean_of(c.transparency), 0.0, 1.0), share = opacity > LEAST ? 1.0 / opacity : 0.0;
    Point p = point_of(hit, s, s.normal);
    p.diffuse = clamp(share * c.mean, 0.0, 1.0);
    p.emission = max(share * c.emission, 0.0);
    p.chance = opacity;
    p.t = mean_of(c.behind) / max(mean_of(c.mean), 1e-6);
    put_point(u_set, slot, p);
}

void scale_lobes(inout Closures c, float k)
{
    c.lobes = sum_of(c.lobes, k, c.lobes, 0.0);
    c.lobes_mass *= k;
}

void scale_ground(inout Closures c, float k)
{
    c.ground *= k;
    c.ground_mass *= k;
}

void drop_lobes(inout Closures c)
{
    c.lobes = no_lobes(vec2(1.0));
    c.lobes_mass = 0.0;
}

void drop_ground(inout Closures c)
{
    c.ground = vec3(0.0);
    c.ground_mass = 0.0;
    c.shape = LAMBERT;
}

// Light that passes, beyond the share that rays pass by anyway, is let through by a pane that bends nothing.
void add_pane(inout Closures c, float opacity)
{
    Bsdf pane = no_lobes(vec2(0.0));
    pane.glass_through = max(c.transparency - (1.0 - opacity), 0.0);
    if (mean_of(pane.glass_through) < LEAST)
        return;
    pane.is_level = true;
    pane.transmission = pane.glass_through;
    add_lobes(c, pane, c.ground_mass > 0.0 ? c.ground_normal : c.lobes_normal);
}

// A point has one normal, and light from one side for its ground. Of what has another one, or the other side, one is kept.
void choose(inout Closures c, inout bool is_turned)
{
    float behind = mean_of(c.behind), sum = c.ground_mass + c.lobes_mass;
    if (c.ground_mass > 0.0 && c.lobes_mass > 0.0 && c.ground_normal != c.lobes_normal) {
        float p = c.ground_mass / sum;
        if (toss(c, p)) {
            drop_lobes(c);
            scale_ground(c, 1.0 / p);
        } else {
            drop_ground(c);
            scale_lobes(c, 1.0 / (1.0 - p));
        }
    }
    if (behind <= 0.0)
        return;
    float p = behind / (behind + sum);
    is_turned = toss(c, p);
    if (is_turned) {
        drop_lobes(c);
        drop_ground(c);
        c.ground = c.behind / p;
        c.ground_normal = c.behind_normal;
    } else {
        scale_ground(c, 1.0 / (1.0 - p));
        scale_lobes(c, 1.0 / (1.0 - p));
    }
}

// Fill in a slot. opacity: the share of rays that are stopped where the hit is, as it was baked: if it is less than that of the
// point itself, the point stands for no more light than it sends. Light that passes besides is part of the point.
void settle(uint slot, Hit hit, Surface s, Closures c, float opacity)
{
    float share = 1.0 / max(max(opacity, 1.0 - mean_of(c.transparency)), 1e-3);
    bool is_turned = false, is_hole = c.holdout > 0.0 && toss(c, min(share * c.holdout, 1.0));
    if (is_hole) {
        Point hole = point_of(hit, s, s.normal);
        hole.kind = POINT_HOLDOUT;
        put_point(u_set, slot, hole);
        return;
    }
    if (c.holdout > 0.0)
        share /= max(1.0 - share * c.holdout, 1e-3);
    add_pane(c, opacity);
    choose(c, is_turned);
    Point p = point_of(hit, s, c.ground_mass > 0.0 || is_turned || c.lobes_mass == 0.0 ? c.ground_normal : c.lobes_normal);
    p.diffuse = share * c.ground;
    p.emission = share * c.emission;
    if (is_turned) {
        p.kind |= POINT_TURNED;
        p.normal = -p.normal;
        p.normal_geometric = -p.normal_geometric;
        p.lift = vec3(0.0);
    }
    scale_lobes(c, share);
    if (c.shape.kind != SHAPE_LAMBERT) {
        p.kind |= POINT_SHAPED;
        put_shape(u_set, slot, c.shape);
    }
    put_shaded(slot, p, c.lobes);
}
