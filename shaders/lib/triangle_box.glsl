// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: which voxels a triangle touches [Schwarz10], and the part of it inside one. Voxel units; axes are turned so
// that z is the triangle's dominant axis, along which it is widest.

struct VoxelTriangle {
    vec3 a, b, c;  // corners, axes turned
    vec3 n;        // cross(b - a, c - a), axes turned
    int axis;      // the dominant axis before the turn
    ivec3 low;     // first and last cell of the bounding box, clamped to the grid; no column if there is no area
    ivec3 high;
    float slack;   // along z: TOUCH, and by how much rounding of the normal tilts the plane of a sliver
};

// Slack for rounding: a voxel that a surface only touches counts as touched.
const float TOUCH = 1e-4;

vec3 turned(vec3 v, int axis)
{
    return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v;
}

ivec3 turned_back(ivec3 v, int axis)
{
    return axis == 0 ? v.zxy : axis == 1 ? v.yzx : v;
}

vec3 turned_back(vec3 v, int axis)
{
    return axis == 0 ? v.zxy : axis == 1 ? v.yzx : v;
}

VoxelTriangle voxel_triangle(vec3 a, vec3 b, vec3 c, int n)
{
    vec3 normal = cross(b - a, c - a), size = abs(normal);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    VoxelTriangle t;
    t.axis = axis;
    t.a = turned(a, axis), t.b = turned(b, axis), t.c = turned(c, axis), t.n = turned(normal, axis);
    vec3 lowest = min(min(t.a, t.b), t.c), highest = max(max(t.a, t.b), t.c), extent = highest - lowest;
    t.low = clamp(ivec3(floor(lowest - TOUCH)), ivec3(0), ivec3(n - 1));
    t.high = clamp(ivec3(floor(highest + TOUCH)), ivec3(0), ivec3(n - 1));
    float side = max(max(extent.x, extent.y), extent.z);
    t.slack = TOUCH + min(3e-7 * side * side * side / abs(t.n.z), float(n));
    if (t.n.z == 0.0)
        t.high = t.low - 1;
    return t;
}

// Unit normal, axes turned; scaled first, so that the square of no small one is lost.
vec3 unit_normal(VoxelTriangle t)
{
    return normalize(t.n / abs(t.n.z));
}

// Do the triangle and the unit square at `cell` overlap, both projected on a plane? winding: sign of the projected area.
bool overlaps_square(vec2 a, vec2 b, vec2 c, float winding, vec2 cell)
{
    vec2 corners[3] = vec2[3](a, b, c);
    for (int i = 0; i < 3; i++) {
        vec2 p = corners[i], e = corners[(i + 1) % 3] - p;
        vec2 inward = winding * vec2(-e.y, e.x);
        vec2 farthest = cell + vec2(greaterThan(inward, vec2(0.0)));
        if (dot(inward, farthest - p) < -TOUCH * (abs(inward.x) + abs(inward.y)))
            return false;
    }
    return true;
}

bool touches_column(VoxelTriangle t, ivec2 column)
{
    return overlaps_square(t.a.xy, t.b.xy, t.c.xy, sign(t.n.z), vec2(column));
}

// First and last cell along z in which the triangle's plane crosses the column.
ivec2 column_range(VoxelTriangle t, ivec2 column)
{
    vec2 slope = -t.n.xy / t.n.z;
    float middle = t.a.z + dot(slope, vec2(column) + 0.5 - t.a.xy);
    float half_height = 0.5 * (abs(slope.x) + abs(slope.y)) + t.slack;
    return ivec2(max(int(floor(middle - half_height)), t.low.z), min(int(floor(middle + half_height)), t.high.z));
}

// Given that column and plane fit: do the other two projections overlap as well?
bool touches_cell(VoxelTriangle t, ivec3 cell)
{
    return overlaps_square(t.a.yz, t.b.yz, t.c.yz, sign(t.n.x), vec2(cell.yz))
        && overlaps_square(t.a.zx, t.b.zx, t.c.zx, sign(t.n.y), vec2(cell.zx));
}

const int MAX_CORNERS = 9;  // a triangle cut by six planes

// Keep the part of a polygon where dot(p, axis) * side <= limit [Sutherland74].
void clip_polygon(inout vec3 polygon[MAX_CORNERS], inout int n, int axis, float side, float limit)
{
    vec3 kept[MAX_CORNERS];
    int n_kept = 0;
    for (int i = 0; i < n; i++) {
        vec3 p = polygon[i], q = polygon[i + 1 < n ? i + 1 : 0];
        float dp = side * p[axis] - limit, dq = side * q[axis] - limit;
        if (dp <= 0.0 && n_kept < MAX_CORNERS)
            kept[n_kept++] = p;
        if ((dp < 0.0 && dq > 0.0 || dp > 0.0 && dq < 0.0) && n_kept < MAX_CORNERS)
            kept[n_kept++] = mix(p, q, dp / (dp - dq));
    }
    polygon = kept;
    n = n_kept;
}

// Area and centroid of the triangle's part inside the cell: xyz centroid, w area. The triangle's own when nothing is left.
vec4 clipped_part(VoxelTriangle t, ivec3 cell)
{
    vec3 low = vec3(cell), high = low + 1.0;
    vec3 lowest = min(min(t.a, t.b), t.c), highest = max(max(t.a, t.b), t.c);
    vec3 polygon[MAX_CORNERS];
    polygon[0] = t.a, polygon[1] = t.b, polygon[2] = t.c;
    int n = 3;
    for (int axis = 0; axis < 3; axis++) {
        if (lowest[axis] < low[axis])
            clip_polygon(polygon, n, axis, -1.0, -low[axis]);
        if (highest[axis] > high[axis])
            clip_polygon(polygon, n, axis, 1.0, high[axis]);
    }
    float area = 0.0;
    vec3 moment = vec3(0.0), normal = unit_normal(t);
    for (int i = 1; i + 1 < n; i++) {
        float part = 0.5 * abs(dot(cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]), normal));
        area += part;
        moment += part * (polygon[0] + polygon[i] + polygon[i + 1]) / 3.0;
    }
    return area > 1e-12 ? vec4(moment / area, area) : vec4(clamp((t.a + t.b + t.c) / 3.0, low, high), 0.0);
}

// Barycentrics (of b and c) of a point in the triangle's plane, clamped to the triangle.
vec2 barycentrics(VoxelTriangle t, vec3 p)
{
    vec2 e1 = t.b.xy - t.a.xy, e2 = t.c.xy - t.a.xy, d = p.xy - t.a.xy;
    vec2 bary = vec2(d.x * e2.y - d.y * e2.x, e1.x * d.y - e1.y * d.x) / (e1.x * e2.y - e1.y * e2.x);
    bary = clamp(bary, 0.0, 1.0);
    return bary / max(bary.x + bary.y, 1.0);
}
