// SPDX-License-Identifier: Apache-2.0
#include "closest_point.h"

#include <algorithm>

namespace spa {
namespace {

Vec3d closest_on_edges(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    Vec3d best = closest_point_on_segment(p, a, b);
    for (const Vec3d q : {closest_point_on_segment(p, b, c), closest_point_on_segment(p, c, a)}) {
        if (dot(q - p, q - p) < dot(best - p, best - p)) best = q;
    }
    return best;
}

} // namespace

Vec3d closest_point_on_segment(Vec3d p, Vec3d a, Vec3d b) {
    const Vec3d ab = b - a;
    const double length2 = dot(ab, ab);
    if (!(length2 > 0)) return a;
    return a + ab * std::clamp(dot(p - a, ab) / length2, 0.0, 1.0);
}

Vec3d closest_point_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d ab = b - a;
    const Vec3d ac = c - a;
    const double d1 = dot(ab, p - a);
    const double d2 = dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = dot(ab, p - b);
    const double d4 = dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double d5 = dot(ab, p - c);
    const double d6 = dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double va = d3 * d6 - d5 * d4;
    const double vb = d5 * d2 - d1 * d6;
    const double vc = d1 * d4 - d3 * d2;
    const double sum = va + vb + vc;
    // Beyond an edge, or of no area.
    if (!(va > 0 && vb > 0 && vc > 0) || !(sum > 0)) return closest_on_edges(p, a, b, c);
    return a + ab * (vb / sum) + ac * (vc / sum);
}

} // namespace spa
