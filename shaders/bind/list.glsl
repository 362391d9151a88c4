// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: which slots a program is for: all, or those of paths that go on. Their number is known on the device alone, so as
// many invocations as keep it busy take them in turns.

#include "bind/wave.glsl"

layout(std430) readonly buffer List { uint list[]; };  // the number of slots, then they themselves

uniform bool u_is_listed;
uniform uint u_step;       // to an invocation's next index; ONCE: it has one alone
uniform uint u_n_all;      // slots, where they are not listed

const uint LIST_HEAD = 4u;
const uint ONCE = 0x7fffffffu;

// The index after the last one.
uint n_slots()
{
    uint end = u_is_listed ? list[0] : u_n_all;
    return u_step == ONCE ? min(end, u_end) : end;
}

uint slot_of(uint index)
{
    return u_is_listed ? list[LIST_HEAD + index] : index;
}
