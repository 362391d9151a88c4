// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: where the host puts the text of a compiled tree: what defines `surface`, and `styled` if it goes
// on with light as a colour. This one is black.

#include "nodes/closures.glsl"

void surface(Geo g, inout Closures c)
{
}

void styled(Geo g, inout Closures c)
{
}
