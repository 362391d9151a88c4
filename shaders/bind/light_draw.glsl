// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what a draw of light is.

struct LightDraw {
    vec3 wi;         // unit, towards the light
    float distance;  // metres
    vec3 E_perp;     // irradiance [W m^-2] of a surface that faces it; the sum over all draws is the light that arrives
    float pdf;       // [sr^-1] with which wi is drawn, times the number of such draws; 0: nothing else finds this light
};

const LightDraw NO_DRAW = LightDraw(vec3(0.0), 0.0, vec3(0.0), 0.0);
