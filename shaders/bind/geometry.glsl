// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the scene's triangles as surfaces.

#include "bind/vertices.glsl"
#include "lib/math.glsl"
#include "lib/surface.glsl"

layout(std430) readonly buffer CornerNormals { uint corner_normals[]; };  // three a triangle, octahedral, object space

// A surface and what a material asks of it.
struct Seen {
    Surface surface;
    vec2 uv;
    vec3 tangent;           // along u, not normalised; zero without texture coordinates
    vec3 bitangent;         // along v, not normalised
    uint material;
    bool is_back;           // seen from behind: inside of what the mesh encloses
};

// 1, or -1 for an instance that mirrors its mesh: it turns round the way in which triangles are wound.
float handedness(Instance instance)
{
    return dot(cross(instance.row_x.xyz, instance.row_y.xyz), instance.row_z.xyz) < 0.0 ? -1.0 : 1.0;
}

// Normals go by the cofactors, which are the inverse transpose times the determinant.
vec3 normal_to_world(Instance instance, vec3 n_os)
{
    vec3 x = instance.row_x.xyz, y = instance.row_y.xyz, z = instance.row_z.xyz;
    return handedness(instance) * vec3(dot(cross(y, z), n_os), dot(cross(z, x), n_os), dot(cross(x, y), n_os));
}

// How far p must be lifted to lie on the tangent planes of the corners, which face `side`, mean over them [Hanika21].
vec3 lift(vec3 p, mat3 corners, mat3 normals, vec3 weights, float side)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 3; i++)
        sum -= weights[i] * min(side * dot(p - corners[i], normals[i]), 0.0) * side * normals[i];
    return sum;
}

// A point of a triangle as seen from the direction wo: both normals on its side.
Seen seen_at(uint instance, uint triangle, vec2 bary, vec3 wo)
{
    uvec4 corners = triangles[triangle];
    vec3 a = vertex_ws(instance, corners.x), b = vertex_ws(instance, corners.y), c = vertex_ws(instance, corners.z);
    vec3 ab = b - a, ac = c - a;
    Surface s;
    s.position = a + bary.x * ab + bary.y * ac;
    s.normal_geometric = handedness(instances[instance]) * normalize(cross(ab, ac));
    vec3 weights = vec3(1.0 - bary.x - bary.y, bary);
    mat3 normals;
    for (uint i = 0u; i < 3u; i++)
        normals[i] = normalize(normal_to_world(instances[instance], unpack_unit(corner_normals[3u * triangle + i])));
    vec3 n = normals * weights;
    s.normal = dot(n, n) > 1e-20 ? normalize(n) : s.normal_geometric;
    bool is_back = dot(s.normal_geometric, wo) < 0.0;
    float side = is_back ? -1.0 : 1.0;
    s.lift = lift(s.position, mat3(a, b, c), normals, weights, side);
    s.normal_geometric *= side;
    s.normal *= side;
    return Seen(s, vec2(0.0), vec3(0.0), vec3(0.0), material_of(instance, triangle), is_back);
}

// Fill in what images need: where on them the point lies, and which way they run.
void add_uv(inout Seen seen, uint instance, uint triangle, vec2 bary)
{
    if (corner_uvs.length() < 3)
        return;
    uvec4 corners = triangles[triangle];
    vec3 a = vertex_ws(instance, corners.x), ab = vertex_ws(instance, corners.y) - a, ac = vertex_ws(instance, corners.z) - a;
    vec2 t0 = corner_uvs[3u * triangle], t1 = corner_uvs[3u * triangle + 1u] - t0, t2 = corner_uvs[3u * triangle + 2u] - t0;
    seen.uv = t0 + bary.x * t1 + bary.y * t2;
    float orientation = sign(t1.x * t2.y - t2.x * t1.y);
    seen.tangent = (t2.y * ab - t1.y * ac) * orientation;
    seen.bitangent = (t1.x * ac - t2.x * ab) * orientation;
}

// A shading normal that faces away would see nothing: bend it until it grazes.
vec3 facing(vec3 normal, vec3 wo)
{
    float NoV = dot(normal, wo);
    return NoV < 1e-3 ? normalize(normal + (1e-3 - NoV) * wo) : normal;
}

// The instance that holds triangle number `work` when the triangles of all n instances are counted one after another.
uint instance_of_work(uint work, uint n)
{
    uint low = 0u, high = n;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (instances[middle].first_work <= work)
            low = middle;
        else
            high = middle;
    }
    return low;
}
