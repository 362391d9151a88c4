// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    the irradiance of points from the light cache, by exact rays or by rays through voxels: how fast, how far off.
// Formula:    E = pi / N sum L(w_i), w_i distributed as cos
// In:         Starts: points and their normals; the light cache, triangles
// Out:        Found: E [W m^-2], and with COMPARE how many rays end too early, plus 1024 times how many too late
// Invocation: one point

#include "bind/environment.glsl"
#include "bind/surfel_colors.glsl"
#include "bind/trace.glsl"
#include "bind/vertices.glsl"
#include "../tools/voxel_rays/trace_voxels.glsl"

const int WAY = 0;            // 0 exact, 1 voxels, 2 exact for NEAR voxels and voxels from there on
const bool SHADE = true;      // read the light of what is hit
const bool COMPARE = false;
const int N_RAYS = 16;
const float NEAR = 4.0;       // voxels
const float FAR_OFF = 2.0;    // voxels by which a ray ends too early or too late to be taken for right

layout(std430) readonly buffer Starts { vec4 starts[]; };  // two a point: metres relative to the scene's centre; unit
layout(std430) writeonly buffer Found { vec4 found[]; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_round;  // another number gives other directions

vec3 side_radiance(uint side)
{
    vec3 E = cache[cache_entry(LAMPS, side)].rgb + cache[cache_entry(INDIRECT, side)].rgb;
    return emission_of_surfel(side / 2u) + albedo_of_surfel(side / 2u) / PI * E;
}

vec3 exact(vec3 o, vec3 d, float t_max, uint seed, out float t)
{
    Crossing hit;
    bool is_hit = trace_closest(o, d, t_max, seed, hit);
    t = hit.t;
    if (!SHADE || !is_hit)
        return SHADE ? world_radiance(d, 0.0) : vec3(min(t, 1.0));
    uvec4 corners = triangles[hit.triangle];
    vec3 a = vertex_ws(hit.instance, corners.x);
    vec3 n = cross(vertex_ws(hit.instance, corners.y) - a, vertex_ws(hit.instance, corners.z) - a);
    uint side = cache_side(o + hit.t * d, n, d);
    return side == NOTHING ? vec3(0.0) : side_radiance(side);
}

vec3 by_voxels(vec3 o, vec3 d, float t_min, out float t)
{
    VoxelHit hit;
    bool is_hit = trace_voxels(to_voxels(o), d, t_min, hit);
    t = is_hit ? hit.t / u_voxels_per_metre : INFINITE;
    if (!SHADE || !is_hit)
        return SHADE ? world_radiance(d, 0.0) : vec3(min(t, 1.0));
    return side_radiance(2u * hit.surfel + (dot(unpack_unit(surfels[hit.surfel].normal), d) < 0.0 ? 0u : 1u));
}

vec3 arriving(vec3 p, vec3 n, vec3 d, uint seed, out float t)
{
    vec3 o = offset_origin(p, n, d);
    float near = NEAR / u_voxels_per_metre;
    if (WAY == 1)
        return by_voxels(p + n * (PLANES ? START : 1.0) / u_voxels_per_metre, d, 0.0, t);
    vec3 L = exact(o, d, WAY == 2 ? near : INFINITE, seed, t);
    return WAY == 2 && t >= near ? by_voxels(o, d, NEAR, t) : L;
}

void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i >= u_end)
        return;
    vec3 p = starts[2u * i].xyz, n = starts[2u * i + 1u].xyz, E = vec3(0.0);
    mat3 frame = frame_of(n);
    float wrong = 0.0, t, t_exact;
    for (int k = 0; k < N_RAYS; k++) {
        uint seed = hash(hash(i) + u_round);
        vec3 d = frame * cosine_direction(sobol_point(uint(k), seed));
        E += PI / float(N_RAYS) * arriving(p, n, d, seed, t);
        if (COMPARE) {
            exact(offset_origin(p, n, d), d, INFINITE, seed, t_exact);
            float off = (t - t_exact) * u_voxels_per_metre;
            wrong += off < -FAR_OFF ? 1.0 : off > FAR_OFF ? 1024.0 : 0.0;
        }
    }
    found[i] = vec4(E, wrong);
}
