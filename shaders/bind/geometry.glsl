// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the scene's triangles and the functions that read them. Positions are metres relative to the grid's centre.

#include "lib/layouts.glsl"
#include "lib/math.glsl"

layout(std430) readonly buffer Instances { Instance instances[]; };
layout(std430) readonly buffer Positions { float positions[]; };          // xyz of each vertex, object space
layout(std430) readonly buffer Triangles { uvec4 triangles[]; };          // three vertices, material slot
layout(std430) readonly buffer CornerNormals { uint corner_normals[]; };  // three a triangle, octahedral, object space
layout(std430) readonly buffer CornerUvs { vec2 corner_uvs[]; };          // three a triangle; one entry if unused
layout(std430) readonly buffer SlotMaterials { uint slot_materials[]; };

struct Surface {
    vec3 position;
    vec3 normal_geometric;  // unit, as the mesh winds its triangle; turned round with an instance that mirrors
    vec3 normal;            // unit, shading normal
    vec3 lift;              // from the triangle to the curved surface that its corner normals suggest
    vec3 tangent;           // along u, not normalised; zero without texture coordinates
    vec3 bitangent;         // along v, not normalised
    vec2 uv;
    uint material;
    bool is_back;           // seen from behind: inside of what the mesh encloses
};

vec3 to_world(Instance instance, vec3 p_os)
{
    vec4 p = vec4(p_os, 1.0);
    return vec3(dot(instance.row_x, p), dot(instance.row_y, p), dot(instance.row_z, p));
}

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

vec3 vertex_os(uint vertex)
{
    return vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
}

vec3 vertex_ws(uint instance, uint vertex)
{
    return to_world(instances[instance], vertex_os(vertex));
}

uint material_of(uint instance, uint triangle)
{
    return slot_materials[instances[instance].first_slot + triangles[triangle].w];
}

// Texture coordinates at barycentrics (of the second and third corner).
vec2 uv_at(uint triangle, vec2 bary)
{
    vec2 a = corner_uvs[3u * triangle], b = corner_uvs[3u * triangle + 1u], c = corner_uvs[3u * triangle + 2u];
    return a + bary.x * (b - a) + bary.y * (c - a);
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
Surface surface_at(uint instance, uint triangle, vec2 bary, vec3 wo, bool has_uvs)
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
    s.is_back = dot(s.normal_geometric, wo) < 0.0;
    float side = s.is_back ? -1.0 : 1.0;
    s.lift = lift(s.position, mat3(a, b, c), normals, weights, side);
    s.normal_geometric *= side;
    s.normal *= side;
    s.tangent = s.bitangent = vec3(0.0);
    s.uv = vec2(0.0);
    s.material = material_of(instance, triangle);
    if (has_uvs) {
        vec2 t0 = corner_uvs[3u * triangle], t1 = corner_uvs[3u * triangle + 1u] - t0, t2 = corner_uvs[3u * triangle + 2u] - t0;
        s.uv = t0 + bary.x * t1 + bary.y * t2;
        float orientation = sign(t1.x * t2.y - t2.x * t1.y);
        s.tangent = (t2.y * ab - t1.y * ac) * orientation;
        s.bitangent = (t1.x * ac - t2.x * ab) * orientation;
    }
    return s;
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
