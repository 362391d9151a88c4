// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    which triangle is seen, and where on it; all else is fetched later, once a pixel.
// In:         instance, triangle, barycentrics
// Out:        instance + 1 (0: nothing), triangle, barycentrics of the second and third corner as float bits
// Invocation: one fragment; cut-outs by alpha are decided by a random number a sample, whose mean is the blend

#include "bind/opacity.glsl"
#include "lib/math.glsl"

uniform uint u_sample;
uniform uint u_seed;

flat in uvec2 v_instance_triangle;
in vec2 v_bary;

layout(location = 0) out uvec4 o_visibility;

void main()
{
    uint instance = v_instance_triangle.x, triangle = v_instance_triangle.y;
    if (cutouts[instance] != 0u) {
        uvec2 pixel = uvec2(gl_FragCoord.xy);
        uint seed = hash(pixel.x + hash(pixel.y + hash(instance ^ hash(triangle ^ hash(u_seed)))));
        if (opacity_at(instance, triangle, v_bary) <= sobol_point(u_sample, seed).x)
            discard;
    }
    o_visibility = uvec4(instance + 1u, triangle, floatBitsToUint(v_bary));
}
