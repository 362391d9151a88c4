// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: where the host puts the text of a compiled tree: what defines `surface`. This one is black.

#include "nodes/closures.glsl"

void surface(Geo g, inout Closures c)
{
}
