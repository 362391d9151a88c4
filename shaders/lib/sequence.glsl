// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: sample numbers in another order, so that points of one sequence serve dimensions that are independent.

#include "lib/math.glsl"

// Sample number i in an order that `seed` picks: the first 2^n numbers become 2^n neighbours, for every n [Burley20].
uint shuffled(uint i, uint seed)
{
    uint x = bitfieldReverse(i) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return bitfieldReverse(x);
}
