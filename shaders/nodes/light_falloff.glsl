// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the Light Falloff node: strengths that undo the inverse square of the distance.

#include "bind/geo.glsl"
#include "nodes/bounded.glsl"

struct LightFalloff {
    float quadratic;
    float linear;
    float constant;
};

// smoothing: less light from near, by t^2 / (smoothing + t^2).
LightFalloff light_falloff(Geo g, float strength, float smoothing)
{
    float square = bounded(g.t * g.t);
    float left = smoothing > 0.0 ? strength * divided(square, smoothing + square) : strength;
    return LightFalloff(left, bounded(left * g.t), bounded(left * square));
}
