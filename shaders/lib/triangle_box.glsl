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

// Just zero for corners at one place: products are not contracted, else one would be rounded and the other not.
vec3 exact_cross(vec3 u, vec3 v)
{
    precise vec3 uv = u.yzx * v.zxy, vu = u.zxy * v.yzx, n = uv - vu;
    return n;
}

VoxelTriangle voxel_triangle(vec3 a, vec3 b, vec3 c, int n)
{
    vec3 normal = exact_cross(b - a, c - a), size = abs(normal);
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

// Integrals of Y, x Y and Y^2 / 2 over x along a straight line between two points, Y the height y.
vec3 under_line(vec2 p, vec2 q)
{
    float sum = p.y + q.y;
    return (q.x - p.x) / 6.0 * vec3(3.0 * sum, p.x * (p.y + sum) + q.x * (q.y + sum), sum * sum - p.y * q.y);
}

float inverse_of(float d)
{
    return 1.0 / (abs(d) < 1e-20 ? 1e-20 : d);
}

// The same along a segment, x only from 0 to 1 and Y = clamp(y, 0, 1). By Green's theorem the sum over the outline of a
// polygon is the area of its part in the unit square, and that part's first moments, without any corner of the part.
vec3 under_segment(vec2 p, vec2 q)
{
    vec2 d = q - p, per = vec2(inverse_of(d.x), inverse_of(d.y));
    vec2 zero = -p * per, one = (1.0 - p) * per;                 // where x and y are 0 and 1
    vec2 first = min(zero, one), last = max(zero, one);
    float start = clamp(first.x, 0.0, 1.0), end = clamp(last.x, 0.0, 1.0);
    vec4 at = vec4(start, clamp(vec2(first.y, last.y), start, end), end);  // between these Y is straight
    vec4 x = clamp(p.x + at * d.x, 0.0, 1.0), y = clamp(p.y + at * d.y, 0.0, 1.0);
    return under_line(vec2(x.x, y.x), vec2(x.y, y.y)) + under_line(vec2(x.y, y.y), vec2(x.z, y.z))
         + under_line(vec2(x.z, y.z), vec2(x.w, y.w));
}

// The same along the part of an edge with z from 0 to 1. floor_cut, ceiling_cut: where the outline leaves that slab
// through z = 0 and z = 1 (xy), and where it comes back (zw).
vec3 under_edge(vec3 p, vec3 q, inout vec4 floor_cut, inout vec4 ceiling_cut)
{
    vec2 at = clamp((vec2(0.0, 1.0) - p.z) * inverse_of(q.z - p.z), 0.0, 1.0);
    vec2 low = mix(p.xy, q.xy, at.x), high = mix(p.xy, q.xy, at.y);
    if ((p.z < 0.0) != (q.z < 0.0))
        floor_cut = p.z < 0.0 ? vec4(floor_cut.xy, low) : vec4(low, floor_cut.zw);
    if ((p.z > 1.0) != (q.z > 1.0))
        ceiling_cut = p.z > 1.0 ? vec4(ceiling_cut.xy, high) : vec4(high, ceiling_cut.zw);
    return under_segment(p.z < 0.0 ? low : p.z > 1.0 ? high : p.xy, q.z < 0.0 ? low : q.z > 1.0 ? high : q.xy);
}

// Area and centroid of the triangle's part inside the cell: xyz centroid, w area.
vec4 clipped_part(VoxelTriangle t, ivec3 cell)
{
    vec3 low = vec3(cell), a = t.a - low, b = t.b - low, c = t.c - low;
    vec3 lowest = min(min(a, b), c), highest = max(max(a, b), c), middle = (a + b + c) / 3.0;
    float size = 0.5 * abs(t.n.z), area = size;
    if (any(lessThan(lowest, vec3(0.0))) || any(greaterThan(highest, vec3(1.0)))) {
        vec4 floor_cut = vec4(0.0), ceiling_cut = vec4(0.0);
        vec3 sum = under_edge(a, b, floor_cut, ceiling_cut) + under_edge(b, c, floor_cut, ceiling_cut)
                 + under_edge(c, a, floor_cut, ceiling_cut);
        if (lowest.z < 0.0)
            sum += under_segment(floor_cut.xy, floor_cut.zw);
        if (highest.z > 1.0)
            sum += under_segment(ceiling_cut.xy, ceiling_cut.zw);
        sum *= -sign(t.n.z);
        area = clamp(sum.x, 0.0, min(size, 1.0));
        if (area > 1e-6)
            middle.xy = sum.yz / sum.x;
        middle.xy = clamp(middle.xy, lowest.xy, highest.xy);
        middle.z = a.z - dot(t.n.xy, middle.xy - a.xy) / t.n.z;
    }
    return vec4(low + clamp(middle, 0.0, 1.0), area / abs(unit_normal(t).z));
}

// Barycentrics (of b and c) of a point in the triangle's plane, clamped to the triangle.
vec2 barycentrics(VoxelTriangle t, vec3 p)
{
    vec2 e1 = t.b.xy - t.a.xy, e2 = t.c.xy - t.a.xy, d = p.xy - t.a.xy;
    vec2 bary = vec2(d.x * e2.y - d.y * e2.x, e1.x * d.y - e1.y * d.x) / (e1.x * e2.y - e1.y * e2.x);
    bary = clamp(bary, 0.0, 1.0);
    return bary / max(bary.x + bary.y, 1.0);
}
