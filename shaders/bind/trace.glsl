// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: exact rays against the scene's triangles, through a tree of boxes over the instances and one for each mesh.
// Positions are metres relative to the grid's centre; t counts in lengths of d, which need not be a unit vector.
// Triangles have two sides. Where `seed` matters: of a surface with alpha, that share of all seeds is hit.

#include "bind/opacity.glsl"
#include "lib/math.glsl"

const bool IN_LOCKSTEP = false;  // branches that no ray takes cost time too, as on Mesa's software renderer
const int STACK = 64;            // two more than the trees' greatest height
const int QUICK = IN_LOCKSTEP ? STACK : 24;  // of them in shared memory, which takes its room from the caches

uniform usamplerBuffer u_bvh_nodes;      // of BvhNode, and so on, 16 bytes a texel
uniform usamplerBuffer u_bvh_triangles;
uniform usamplerBuffer u_bvh_instances;

uniform uint u_bvh_root;     // of the tree of instances, BVH_NONE if there are none
uniform float u_bvh_extent;  // the scene's largest coordinate

const float BOX_MARGIN = 1e-6;  // of the coordinates: more than the error of the triangle test, eight roundings of 6e-8

// Where a ray met a triangle; bary: of the second and third corner.
struct Crossing {
    float t;
    uint instance;
    uint triangle;
    vec2 bary;
};

BvhNode node_at(uint i)
{
    uvec4 a = texelFetch(u_bvh_nodes, int(4u * i)), b = texelFetch(u_bvh_nodes, int(4u * i + 1u)),
          c = texelFetch(u_bvh_nodes, int(4u * i + 2u)), d = texelFetch(u_bvh_nodes, int(4u * i + 3u));
    return BvhNode(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz));
}

BvhTriangle triangle_at(uint i)
{
    uvec4 a = texelFetch(u_bvh_triangles, int(3u * i)), b = texelFetch(u_bvh_triangles, int(3u * i + 1u)),
          c = texelFetch(u_bvh_triangles, int(3u * i + 2u));
    return BvhTriangle(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(c.xyz));
}

BvhInstance instance_at(uint i)
{
    uvec4 a = texelFetch(u_bvh_instances, int(4u * i)), b = texelFetch(u_bvh_instances, int(4u * i + 1u)),
          c = texelFetch(u_bvh_instances, int(4u * i + 2u)), d = texelFetch(u_bvh_instances, int(4u * i + 3u));
    return BvhInstance(uintBitsToFloat(a), uintBitsToFloat(b), uintBitsToFloat(c), d.x, uintBitsToFloat(d.y));
}

// A ray in the space of one tree.
struct Ray {
    vec3 o;
    vec3 inv_d;
    vec3 shear;    // d.xy / d.z and 1 / d.z, axes turned so that d.z is the largest
    int axis;      // which one that is
    float margin;  // by which boxes are wider for this ray than what they hold
};

// Axes turned so that `axis` comes last.
vec3 turned(vec3 v, int axis)
{
    return axis == 2 ? v : axis == 1 ? v.zxy : v.yzx;
}

Ray make_ray(vec3 o, vec3 d, float extent)
{
    Ray ray;
    vec3 size = abs(d), far = abs(o);
    ray.o = o;
    ray.inv_d = 1.0 / mix(d, vec3(1e-20), lessThan(size, vec3(1e-20)));
    ray.axis = size.z >= max(size.x, size.y) ? 2 : size.y >= size.x ? 1 : 0;
    vec3 d_turned = turned(d, ray.axis);
    ray.shear = vec3(d_turned.xy, 1.0) / d_turned.z;
    ray.margin = BOX_MARGIN * (max(far.x, max(far.y, far.z)) + extent);
    return ray;
}

// Where the ray enters a box, if it does so before t_max.
bool meets_box(Ray ray, vec3 low, vec3 high, float t_max, out float t)
{
    vec3 at_low = (low - (ray.o + ray.margin)) * ray.inv_d, at_high = (high - (ray.o - ray.margin)) * ray.inv_d;
    vec3 enter = min(at_low, at_high), leave = max(at_low, at_high);
    t = max(max(enter.x, enter.y), max(enter.z, 0.0));
    return t <= min(min(leave.x, leave.y), min(leave.z, t_max));
}

// Watertight [Woop13]: what the edge between two triangles makes of a ray is the same seen from both. Products are not
// contracted, so that signs are right or the value is zero, and zero counts as inside.
bool meets_triangle(Ray ray, BvhTriangle triangle, float t_max, out float t, out vec2 bary)
{
    precise vec3 a = turned(triangle.a - ray.o, ray.axis), b = turned(triangle.b - ray.o, ray.axis),
                 c = turned(triangle.c - ray.o, ray.axis);
    precise vec2 a2 = a.xy - ray.shear.xy * a.z, b2 = b.xy - ray.shear.xy * b.z, c2 = c.xy - ray.shear.xy * c.z;
    precise float u = c2.x * b2.y - c2.y * b2.x, v = a2.x * c2.y - a2.y * c2.x, w = b2.x * a2.y - b2.y * a2.x;
    float det = u + v + w;
    t = (u * a.z + v * b.z + w * c.z) * ray.shear.z / det;
    bary = vec2(v, w) / det;
    bool is_inside = min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
    return is_inside && det != 0.0 && t > 0.0 && t < t_max;
}

// Whether a surface with alpha lets this ray through.
bool is_cut_out(Crossing c, uint seed)
{
    uint chance = hash(hash(seed ^ hash(c.instance ^ hash(c.triangle))));
    return opacity_at(c.instance, c.triangle, c.bary) <= float(chance >> 8u) / 16777216.0;
}

// The ray in the space of an instance: d keeps its length in world units, so that t stays what it is.
Ray enter_instance(BvhInstance instance, vec3 o, vec3 d)
{
    vec4 o1 = vec4(o, 1.0);
    vec3 o_os = vec3(dot(instance.inv_x, o1), dot(instance.inv_y, o1), dot(instance.inv_z, o1));
    vec3 d_os = vec3(dot(instance.inv_x.xyz, d), dot(instance.inv_y.xyz, d), dot(instance.inv_z.xyz, d));
    return make_ray(o_os, d_os, instance.extent);
}

// References yet to visit: BVH_NONE lies below those of the tree of instances, and below those of an instance. The first
// ones lie in shared memory, each invocation's next to the other ones': where they are private, an H100 gathers in three
// times the time. Few rays need more, and only in trees so high.
layout(local_size_x = 32) in;

layout(std430) buffer TraceRest { uint trace_rest[]; };

const int GROUP = 32;  // invocations of a workgroup that traces

uniform uint u_trace_stride;  // invocations that TraceRest has room for

shared uint trace_stack[QUICK * GROUP];
int trace_top;

uint at_rest()
{
    return uint(trace_top - QUICK) * u_trace_stride + gl_GlobalInvocationID.x;
}

void push(uint reference)
{
    if (QUICK == STACK || trace_top < QUICK)
        trace_stack[trace_top * GROUP + int(gl_LocalInvocationIndex)] = reference;
    else
        trace_rest[at_rest()] = reference;
    trace_top++;
}

uint pop()
{
    trace_top--;
    if (QUICK == STACK || trace_top < QUICK)
        return trace_stack[trace_top * GROUP + int(gl_LocalInvocationIndex)];
    return trace_rest[at_rest()];
}

// What comes after a node: the nearer child that the ray meets, while the other one waits.
uint next_of(uint reference, Ray ray, float t_max)
{
    BvhNode node = node_at(reference);
    float t_a, t_b;
    bool in_a = meets_box(ray, node.low_a, node.high_a, t_max, t_a);
    bool in_b = meets_box(ray, node.low_b, node.high_b, t_max, t_b);
    if (!in_a && !in_b)
        return pop();
    bool is_a_next = in_a && (!in_b || t_a <= t_b);
    if (in_a && in_b)
        push(is_a_next ? node.child_b : node.child_a);
    return is_a_next ? node.child_a : node.child_b;
}

// The nearest hit, or with `any_will_do` some hit, before t_max. Both levels in one loop, and a loop inside it over nodes
// alone, so that neighbours come to their leaves together. Rays that any hit ends are a third quicker without (on an H100).
// A triangle that may let the ray through is looked at outside of these loops: what stands inside is paid for by all.
bool trace(vec3 o, vec3 d, float t_max, uint seed, bool any_will_do, out Crossing hit)
{
    hit = Crossing(t_max, BVH_NONE, 0u, vec2(0.0));
    Crossing met = hit;
    Ray ray = make_ray(o, d, u_bvh_extent), ray_ws = ray;
    trace_top = 0;
    push(BVH_NONE);
    uint reference = u_bvh_root, instance = BVH_NONE;
    bool is_opaque = true;
    do {
        met.instance = BVH_NONE;
        while (met.instance == BVH_NONE) {
            while (reference < BVH_LEAF) {
                reference = next_of(reference, ray, hit.t);
                if (any_will_do && !IN_LOCKSTEP)
                    break;
            }
            if (reference < BVH_LEAF)
                continue;
            if (reference == BVH_NONE && instance == BVH_NONE)
                break;
            if (reference == BVH_NONE) {
                instance = BVH_NONE;
                ray = ray_ws;
                reference = pop();
            } else if (instance == BVH_NONE) {
                instance = reference - BVH_LEAF;
                BvhInstance entered = instance_at(instance);
                ray = enter_instance(entered, o, d);
                is_opaque = cutouts[instance] == 0u;
                reference = entered.root;
                push(BVH_NONE);
            } else {
                BvhTriangle triangle = triangle_at(reference - BVH_LEAF);
                float t;
                vec2 bary;
                if (meets_triangle(ray, triangle, hit.t, t, bary)) {
                    if (!is_opaque) {
                        met = Crossing(t, instance, triangle.triangle, bary);
                    } else {
                        hit = Crossing(t, instance, triangle.triangle, bary);
                        if (any_will_do)
                            return true;
                    }
                }
                reference = pop();
            }
        }
        if (met.instance != BVH_NONE && !is_cut_out(met, seed)) {
            hit = met;
            if (any_will_do)
                return true;
        }
    } while (met.instance != BVH_NONE);
    return hit.instance != BVH_NONE;
}

bool trace_closest(vec3 o, vec3 d, float t_max, uint seed, out Crossing hit)
{
    return trace(o, d, t_max, seed, false, hit);
}

// The start of a ray along d from surface point p: off the surface by 256 units in the last place of each coordinate, more
// than its rounding, in whole steps of the number's own pattern of bits [Waechter19]; near zero by as much as at 1/32 of
// the scene's extent.
vec3 offset_origin(vec3 p, vec3 n_geometric, vec3 d)
{
    vec3 n = dot(n_geometric, d) < 0.0 ? -n_geometric : n_geometric;
    float small = u_bvh_extent / 32.0;
    ivec3 steps = ivec3(256.0 * n);
    vec3 stepped = intBitsToFloat(floatBitsToInt(p) + steps * (1 - 2 * ivec3(lessThan(p, vec3(0.0)))));
    vec3 shifted = p + n * small / 65536.0;
    return mix(stepped, shifted, lessThan(abs(p), vec3(small)));
}
