// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    direct light into the voxels, by Blinn and Phong as in the thesis [Blinn77], with shadows.
// Formula:    L = Le + k_a I_a rho + rho / pi sum (n.l) E + k_s sum (n.h)^alpha E (alpha + 8) / (8 pi), the last factor
//             normalising the highlight; surfaces are lit on both sides, as in Cycles
// In:         Voxels, Occupancy, Lights
// Out:        u_radiance: rgb outgoing radiance [W m^-2 sr^-1] times opacity, a opacity
// Invocation: one occupied voxel

#include "bind/lamp_tables.glsl"
#include "bind/voxels.glsl"

const float START = 2.0;       // voxels between a voxel's centre and the start of its shadow ray: leaves its own surface

layout(local_size_x = 64) in;

layout(std430) readonly buffer Voxels { Voxel voxels[]; };
layout(std430) readonly buffer Lights { Light lights[]; };
layout(rgba16f) uniform writeonly image3D u_radiance;

uniform uint u_first;
uniform uint u_end;
uniform int u_n_lights;
uniform int u_n_points;        // of each extended lamp
uniform vec3 u_eye;            // metres relative to the grid's centre
uniform float u_ambient;       // k_a I_a
uniform float u_specular;      // k_s
uniform float u_shininess;     // alpha

bool is_shadowed(ivec3 voxel, vec3 n, LightSample s)
{
    vec3 o = vec3(voxel) + 0.5 + n * START;
    return is_blocked(o, s.wi, s.distance * u_voxels_per_metre - 2.0 * START);
}

// Cosine and highlight times E of one point of a lamp; a voxel without a normal gets the mean cosine of all directions.
vec2 blinn_phong(vec3 n, bool has_normal, vec3 wi, vec3 wo)
{
    if (!has_normal)
        return vec2(0.5, 0.0);
    float NoH = max(dot(n, normalize(wi + wo)), 0.0);
    return vec2(dot(n, wi), u_specular * pow(NoH, u_shininess) * (u_shininess + 8.0) / (8.0 * PI));
}

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    if (index >= u_end)
        return;
    Voxel voxel = voxels[index];
    ivec3 at = ivec3(voxel.voxel & 1023u, voxel.voxel >> 10u & 1023u, voxel.voxel >> 20u);
    vec4 albedo_coverage = unpackUnorm4x8(voxel.albedo_coverage);
    vec3 rho = albedo_coverage.rgb, p = voxel_centre(at), wo = normalize(u_eye - p);
    bool has_normal = voxel.normal != NO_NORMAL;
    vec3 normal = has_normal ? unpack_unit(voxel.normal) : vec3(0.0);
    vec3 L = voxel.emission + u_ambient * rho;
    for (int i = 0; i < u_n_lights; i++) {
        Light light = lights[i];
        int n_points = light.size == vec2(0.0) ? 1 : u_n_points;
        for (int k = 0; k < n_points; k++) {
            vec2 u = n_points == 1 ? vec2(0.5) : sobol_point(uint(k), 0u);
            LightSample s = sample_lamp(light, p, u);
            vec3 n = has_normal ? normal * (dot(normal, s.wi) < 0.0 ? -1.0 : 1.0) : s.wi;
            if (s.E_perp == vec3(0.0) || (light.casts_shadow != 0u && is_shadowed(at, n, s)))
                continue;
            vec2 terms = blinn_phong(n, has_normal, s.wi, wo);
            L += (rho / PI * terms.x + terms.y) * s.E_perp / float(n_points);
        }
    }
    float opacity = albedo_coverage.a;
    imageStore(u_radiance, at, vec4(min(L, 65504.0) * opacity, opacity));
}
