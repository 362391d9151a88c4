// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: waves as Cycles has them: bands along an axis or rings around one, moved by noise, in three profiles.

#include "nodes/noise_fbm.glsl"

// Before it is looked up: so that whole numbers lie on one side of a step.
vec3 off_steps(vec3 p)
{
    return (p + 0.000001) * 0.999999;
}

float wave_moved(vec3 p, float phase, float distortion, float detail, float detail_scale, float detail_roughness)
{
    if (distortion != 0.0)
        phase += distortion * (2.0 * noise_fbm(3, vec4(p * detail_scale, 0.0), detail, detail_roughness, 2.0, true) - 1.0);
    return phase;
}

// Phases in radians. along: radians for each unit along each axis.
float wave_bands(vec3 along, vec3 at, float scale, float phase, float distortion, float detail, float detail_scale, float detail_roughness)
{
    vec3 p = off_steps(at * scale);
    return wave_moved(p, dot(p, along) + phase, distortion, detail, detail_scale, detail_roughness);
}

// across: 0 along the axis that rings are around, 1 along the others.
float wave_rings(vec3 across, vec3 at, float scale, float phase, float distortion, float detail, float detail_scale, float detail_roughness)
{
    vec3 p = off_steps(at * scale);
    return wave_moved(p, length(p * across) * 20.0 + phase, distortion, detail, detail_scale, detail_roughness);
}

float wave_sine(float phase)
{
    return finite(0.5 + 0.5 * sin(phase - 1.57079632679));
}

float wave_saw(float phase)
{
    return finite(fract(phase / 6.28318530718));
}

float wave_triangle(float phase)
{
    phase /= 6.28318530718;
    return finite(2.0 * abs(phase - floor(phase + 0.5)));
}
