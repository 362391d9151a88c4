// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: where the host puts the text of a compiled displacement. This one moves nothing.

#include "bind/geo.glsl"

vec3 displacement(Geo g)
{
    return vec3(0.0);
}
