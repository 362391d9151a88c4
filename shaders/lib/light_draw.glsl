// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: draws of light, and their weight beside rays that may find the same light.

struct LightDraw {
    vec3 wi;         // unit, towards the light
    float distance;  // metres
    vec3 E_perp;     // irradiance [W m^-2] of a surface that faces it; the sum over all draws is the light that arrives
    float pdf;       // [sr^-1] with which wi is drawn, times the number of such draws; 0: nothing else finds this light
};

const LightDraw NO_DRAW = LightDraw(vec3(0.0), 0.0, vec3(0.0), 0.0);

// Share of what was found with density pdf_own, while something else finds it with pdf_other; all of it if pdf_own is 0.
// Who draws and also follows rays weighs both by this, the balance heuristic [Veach95], and no light is counted twice.
float balance(float pdf_own, float pdf_other)
{
    return pdf_own > 0.0 ? 1.0 / (1.0 + pdf_other / pdf_own) : 1.0;
}
