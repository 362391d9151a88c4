// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: a point of a surface as light meets it: seen from one side, on which both normals lie.

struct Surface {
    vec3 position;          // metres relative to the grid's centre
    vec3 normal_geometric;  // unit, the triangle's
    vec3 normal;            // unit, shading normal
    vec3 lift;              // from the triangle to the curved surface that its corner normals suggest
};

// The same as lit from behind.
Surface turned_round(Surface s)
{
    s.normal = -s.normal;
    s.normal_geometric = -s.normal_geometric;
    s.lift = vec3(0.0);
    return s;
}
