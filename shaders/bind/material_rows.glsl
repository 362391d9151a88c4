// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the table of materials.

#include "lib/layouts.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };
