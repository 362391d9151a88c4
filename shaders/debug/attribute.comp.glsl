// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose:    one attribute of the voxels as a 3D texture, for debug/voxels to show.
// In:         Voxels
// Out:        u_attribute: rgb the attribute times opacity, a opacity
// Invocation: one occupied voxel

#include "lib/layouts.glsl"
#include "lib/math.glsl"

uniform bool u_show_normal;  // the normal as n / 2 + 1 / 2 instead of the albedo

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
    if (u_show_normal)
        value = voxel.normal == NO_NORMAL ? vec3(0.5) : unpack_unit(voxel.normal) * 0.5 + 0.5;
    ivec3 at = ivec3(voxel.voxel & 1023u, voxel.voxel >> 10u & 1023u, voxel.voxel >> 20u);
    imageStore(u_attribute, at, vec4(value * albedo_coverage.a, albedo_coverage.a));
}
