// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    set the bit of every voxel that a triangle touches, completely: no surface has a hole [Schwarz10].
// In:         triangles, StripFirst
// Out:        Occupancy; OR knows no order, so the bits are the same in every run
// Invocation: one strip of columns of one triangle

#include "bind/visit_voxels.glsl"
#include "bind/voxels.glsl"

void visit(Strip strip, ivec3 cell)
{
    uvec2 address = occupancy_address(turned_back(cell, strip.shape.axis));
    atomicOr(occupancy[address.x], 1u << address.y);
}
