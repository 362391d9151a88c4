// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: a surface met by a ray, and the light that leaves it.

#include "bind/cache.glsl"
#include "bind/lights.glsl"
#include "bind/principled.glsl"
#include "bind/surface.glsl"

const float CLOSE = 8.0;  // voxels up to which a diffuse ray sees all that it meets lit exactly

uniform uint u_sample;
uniform uint u_n_samples;  // of the picture, rounded up to a power of 2

uint number;  // of this pixel's points in all sequences

// Pixels one after another along a Z-order curve, u_n_samples numbers each: neighbours share the square of a sequence as
// evenly as the samples of one pixel do, so that little noise is left where a filter joins them [Ahmed20].
uint point_number(ivec2 pixel)
{
    return z_order(uvec2(pixel)) * u_n_samples + u_sample;
}

// A surface met by a ray, its normals turned against the ray.
struct Met {
    Surface surface;
    Shading shading;
    uint side;  // of the light cache
};

Met met_at(Hit hit, vec3 d)
{
    Met met;
    met.surface = seen_surface(hit.instance, hit.triangle, hit.bary, -d, HAS_TEXTURES);
    met.side = cache_side(met.surface.position, met.surface.normal_geometric, d);
    met.shading = shading_at(met.surface.material, met.surface.uv, HAS_TEXTURES);
    return met;
}

// Irradiance of a met surface: lamps exactly, all else from the cache.
vec3 arriving(Met met, uint sample_index, uint seed)
{
    vec3 E = lamps_irradiance(met.surface, 1, sample_index, seed);
    return met.side == NOTHING ? E : E + cache[cache_entry(INDIRECT, met.side)].rgb;
}

// Light that a met surface reflects against a diffuse ray which went t metres: what it mirrors is taken as its share of what
// arrives from everywhere. Far away the edges of shadows may be a voxel wide, so lamps are taken from the cache too; but not
// those of a tree, of which it holds a few draws: their noise would stay.
vec3 reflected(Met met, float t, uint seed)
{
    bool is_far = !HAS_TREE && met.side != NOTHING && t * u_voxels_per_metre > CLOSE;
    vec3 E = is_far ? cache[cache_entry(LAMPS, met.side)].rgb + cache[cache_entry(INDIRECT, met.side)].rgb
                    : arriving(met, number, seed);
    return mean_albedo(materials[met.surface.material], met.shading) / PI * E;
}
