// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: one of many lights, drawn by intensity and distance, and the probability of that [ContyEstevez18]. The trees are
// complete: the root is node 1, node i has the children 2 i and 2 i + 1.

#include "lib/layouts.glsl"

const uint NO_LEAF = 0xffffffffu;

uniform usamplerBuffer u_light_nodes;  // of LightNode, 16 bytes a texel

LightNode light_node(uint i)
{
    uvec4 a = texelFetch(u_light_nodes, int(2u * i)), b = texelFetch(u_light_nodes, int(2u * i + 1u));
    return LightNode(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w);
}

// About how much light comes from a node: its intensity over the squared distance to its middle, or to its corners if that
// is nearer, times the largest cosine under which any point of the ball around its box is seen.
float importance(uint i, vec3 p, vec3 normal)
{
    LightNode node = light_node(i);
    vec3 to_middle = 0.5 * (node.low + node.high) - p, half_size = 0.5 * (node.high - node.low);
    float d2 = dot(to_middle, to_middle), r2 = dot(half_size, half_size), bound = 1.0;
    if (d2 > r2) {
        float cosine = dot(normal, to_middle) * inversesqrt(d2), sin2 = r2 / d2, cos_ball = sqrt(1.0 - sin2);
        if (cosine < cos_ball)
            bound = max(cosine * cos_ball + sqrt(max(1.0 - cosine * cosine, 0.0) * sin2), 0.0);
    }
    return node.intensity * bound / max(max(d2, r2), 1e-12);
}

// Probability of the first child of node i; negative where nothing comes from either. Just 0 or 1 where all comes from one:
// a quotient may round to less on graphics cards, and whoever then drew the other would weigh its light ten millionfold.
float first_probability(uvec2 tree, uint i, vec3 p, vec3 normal)
{
    float first = importance(tree.x + 2u * i, p, normal), second = importance(tree.x + 2u * i + 1u, p, normal);
    if (second == 0.0)
        return first > 0.0 ? 1.0 : -1.0;
    return min(first / (first + second), 1.0);
}

// A leaf of `tree` (its first node, its number of leaves) for a surface at p, u in [0, 1); or NO_LEAF.
uint draw_leaf(uvec2 tree, vec3 p, vec3 normal, float u, out float probability)
{
    uint i = 1u;
    probability = 1.0;
    while (i < tree.y) {
        float first = first_probability(tree, i, p, normal);
        if (first < 0.0)
            return NO_LEAF;
        bool is_second = u >= first;
        float chosen = is_second ? 1.0 - first : first;
        u = min((is_second ? u - first : u) / chosen, 0.9999999);
        probability *= chosen;
        i = 2u * i + uint(is_second);
    }
    return i - tree.y;
}

// The probability with which draw_leaf returns `leaf`.
float leaf_probability(uvec2 tree, uint leaf, vec3 p, vec3 normal)
{
    float probability = 1.0;
    for (uint below = tree.y >> 1u, i = 1u; below > 0u; below >>= 1u) {
        float first = first_probability(tree, i, p, normal);
        bool is_second = (leaf & below) != 0u;
        probability *= first < 0.0 ? 0.0 : is_second ? 1.0 - first : first;
        i = 2u * i + uint(is_second);
    }
    return probability;
}
