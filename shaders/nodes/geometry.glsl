// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the point itself.

#include "bind/geo.glsl"

vec3 normal_of_point(Geo g)
{
    return g.normal;
}
