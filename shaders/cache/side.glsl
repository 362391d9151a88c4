// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: one side of a surfel as a surface that light arrives at.

#include "bind/cache.glsl"
#include "lib/surface.glsl"

Surface surface_of_side(uint side)
{
    Surfel surfel = surfels[side / 2u];
    Surface s;
    s.normal = s.normal_geometric = unpack_unit(surfel.normal) * (side % 2u == 0u ? 1.0 : -1.0);
    s.position = side_position(surfel, side, s.normal);
    s.lift = vec3(0.0);
    return s;
}
