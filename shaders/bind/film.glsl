// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the film: sums over the samples, in planes.

#include "lib/math.glsl"

const int COMBINED = 0;                // premultiplied RGBA
const int DIFFUSE_DIRECT = 1;          // rho / pi E, in alpha the square of E's luminance
const int DIFFUSE_INDIRECT = 2;
const int DIFFUSE_FOUND = 3;           // that part of the indirect light which came straight from emitters or the world
const int DIFFUSE_COLOR = 4;           // rho; in alpha the samples that met a surface
const int GLOSSY_DIRECT = 5;           // L, in alpha the square of the luminance of L / albedo
const int GLOSSY_INDIRECT = 6;
const int GLOSSY_COLOR = 7;            // albedo; in alpha the angle by which the eye sees a reflection blurred
const int TRANSMISSION_DIRECT = 8;
const int TRANSMISSION_INDIRECT = 9;
const int TRANSMISSION_COLOR = 10;
const int EMISSION = 11;
const int ENVIRONMENT = 12;
const int ALBEDO = 13;                 // all colours together, with what shines by itself
const int NORMAL_DEPTH = 14;           // unit normal of the first hit, distance from the eye
const int HALF = 15;                   // as COMBINED, of half of the samples
const int POSITION = 16;               // of the first sample alone, metres relative to the grid's centre; alpha 1
const int ALL_PLANES = 17;

uniform int u_planes[ALL_PLANES];      // the layer that holds each plane; -1: none does

const float MIN_ALBEDO = 1e-4;         // a darker surface's light is not told from its colour

float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}
