// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: voxel cone tracing [Crassin11]: one march through the filtered voxels gathers light and opacity.

#include "bind/grid.glsl"

uniform sampler3D u_radiance;    // rgb outgoing radiance times opacity, a opacity, mip levels by averaging
uniform float u_cone_offset;     // voxels
uniform float u_cone_step;       // part of the cone's diameter
uniform float u_cone_distance;   // voxels

// Light and opacity met in a cone. Voxel space; `d` unit. The march starts u_cone_offset voxels along the normal and as
// many along the cone. The thesis adds the texel's opacity once a step of one voxel, however wide the cone has grown. The
// averaged opacity a is that of one voxel of path, so over a step of s voxels it is 1 - (1 - a)^s, and the light of the
// step follows the opacity.
vec4 trace_cone(vec3 p, vec3 normal, vec3 d, float tan_half_angle, float t_max)
{
    vec3 origin = p + normal * u_cone_offset;
    vec4 sum = vec4(0.0);
    float t = u_cone_offset;
    t_max = min(t_max, u_cone_distance);
    while (t < t_max && sum.a < 0.99) {
        float diameter = max(2.0 * tan_half_angle * t, 1.0);
        vec3 at = (origin + d * t) / float(u_grid_n);
        if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0))))
            break;
        float length = u_cone_step * diameter;
        vec4 texel = textureLod(u_radiance, at, log2(diameter));
        float opacity = 1.0 - pow(1.0 - min(texel.a, 0.9999), length);
        if (texel.a > 0.0)
            sum += (1.0 - sum.a) * vec4(texel.rgb * (opacity / texel.a), opacity);
        t += length;
    }
    return sum;
}
