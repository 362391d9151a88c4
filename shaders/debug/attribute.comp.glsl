// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one attribute of the voxels as a 3D texture, for debug/voxels to show.
// In:         Voxels
// Out:        u_attribute: rgb the attribute times opacity, a opacity
// Invocation: one occupied voxel

#include "lib/layouts.glsl"
#include "lib/math.glsl"

const int ATTRIBUTE = 0;  // 0 albedo, 1 normal (n / 2 + 1 / 2), 2 coverage

layout(local_size_x = 64) in;

layout(std430) readonly buffer Voxels { Voxel voxels[]; };
layout(rgba16f) uniform writeonly image3D u_attribute;

uniform uint u_first;
uniform uint u_end;

void main()
{
    uint index = u_first + gl_GlobalInvocationID.x;
    if (index >= u_end)
        return;
    Voxel voxel = voxels[index];
    vec4 albedo_coverage = unpackUnorm4x8(voxel.albedo_coverage);
    vec3 value = albedo_coverage.rgb;
    if (ATTRIBUTE == 1)
        value = voxel.normal == NO_NORMAL ? vec3(0.5) : unpack_unit(voxel.normal) * 0.5 + 0.5;
    if (ATTRIBUTE == 2)
        value = vec3(albedo_coverage.a);
    ivec3 at = ivec3(voxel.voxel & 1023u, voxel.voxel >> 10u & 1023u, voxel.voxel >> 20u);
    imageStore(u_attribute, at, vec4(value * albedo_coverage.a, albedo_coverage.a));
}
