// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the numbers that voxelize/block_sums and voxelize/scan add up: 2048 of them a block, eight an invocation.

uniform bool u_are_bits;  // a value is the number of bits that are set in its word

layout(local_size_x = 256) in;

layout(std430) buffer Values { uint values[]; };

uniform uint u_first;
uniform uint u_end;
uniform uint u_n_values;

uint value_at(uint i)
{
    if (i >= u_n_values)
        return 0u;
    return u_are_bits ? uint(bitCount(values[i])) : values[i];
}

uint block_of_workgroup()
{
    return u_first / 256u + gl_WorkGroupID.x;
}
