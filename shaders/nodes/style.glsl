// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: Shader to RGB: the light that a point sends to the eye, as a colour that a tree goes on with.

vec3 lit_light = vec3(0.0);  // radiance, set before the rest of the tree is evaluated

vec3 lit_color()
{
    return lit_light;
}
