// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    how many bits are set in each word.
// In:         Bits
// Out:        BitFirst: the count, which voxelize/scan turns into the number of the word's first bit
// Invocation: one word

layout(local_size_x = 64) in;

layout(std430) readonly buffer Bits { uint bits[]; };
layout(std430) writeonly buffer BitFirst { uint bit_first[]; };

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint word = u_first + gl_GlobalInvocationID.x;
    if (word < u_end)
        bit_first[word] = uint(bitCount(bits[word]));
}
