// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the film: sums over the samples. The host says which layer holds each plane; -1: none does.

#include "lib/math.glsl"

const int N_PLANES = 1;
const int PLANE_COMBINED = 0;             // premultiplied RGBA
const int PLANE_DIFFUSE_DIRECT = -1;      // rho / pi E, in alpha the square of E's luminance
const int PLANE_DIFFUSE_INDIRECT = -1;
const int PLANE_DIFFUSE_FOUND = -1;       // that part of the indirect light which came straight from emitters or the world
const int PLANE_DIFFUSE_COLOR = -1;       // rho; in alpha the samples that met a surface
const int PLANE_GLOSSY_DIRECT = -1;       // L, in alpha the square of the luminance of L / albedo
const int PLANE_GLOSSY_INDIRECT = -1;
const int PLANE_GLOSSY_COLOR = -1;        // albedo; in alpha the angle by which the eye sees a reflection blurred
const int PLANE_TRANSMISSION_DIRECT = -1;
const int PLANE_TRANSMISSION_INDIRECT = -1;
const int PLANE_TRANSMISSION_COLOR = -1;
const int PLANE_EMISSION = -1;
const int PLANE_ENVIRONMENT = -1;
const int PLANE_ALBEDO = -1;              // all colours together, with what shines by itself
const int PLANE_NORMAL_DEPTH = -1;        // unit normal of the first hit, distance from the eye
const int PLANE_HALF = -1;                // as COMBINED, of half of the samples
const int PLANE_POSITION = -1;            // of the first sample alone, metres relative to the grid's centre; alpha 1

const float MIN_ALBEDO = 1e-4;            // a darker surface's light is not told from its colour

float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}
