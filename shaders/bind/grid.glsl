// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: where the voxel grid lies. Voxel space (_vx) has its origin at the grid's lowest corner and one voxel as unit.

uniform int u_grid_n;             // voxels along each side, a multiple of 4
uniform vec3 u_grid_low;          // lowest corner, metres relative to the grid's centre
uniform float u_voxels_per_metre;

vec3 to_voxels(vec3 p_ws)
{
    return (p_ws - u_grid_low) * u_voxels_per_metre;
}

vec3 voxel_centre(ivec3 voxel)
{
    return u_grid_low + (vec3(voxel) + 0.5) / u_voxels_per_metre;
}
