// SPDX-License-Identifier: Apache-2.0
// Rotations as quaternions, and the local transforms of nodes that are written as translation, rotation and
// scale.
#pragma once

#include "affine.h"

#include <cmath>

namespace spa {

// x i + y j + z k + w. Of any length; q and -q are the same rotation. Zero is none: the functions below give
// what their formulas leave, never NaN.
struct Quaternion {
    double x = 0, y = 0, z = 0, w = 1;
    friend constexpr bool operator==(const Quaternion&, const Quaternion&) = default;
};

constexpr double dot(const Quaternion& a, const Quaternion& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

inline Quaternion normalize(const Quaternion& q) {
    const double size = std::sqrt(dot(q, q));
    if (!(size > 0)) return {};
    return {q.x / size, q.y / size, q.z / size, q.w / size};
}

// First the scale, then the rotation, then the translation (glTF 2.0, 3.5.3).
constexpr Affine from_trs(Vec3d translation, const Quaternion& q, Vec3d scale) {
    const double norm = dot(q, q);
    const double k = norm > 0 ? 2.0 / norm : 0.0; // any length, so normalised here
    Affine map;
    map.linear.row[0] = {1 - k * (q.y * q.y + q.z * q.z), k * (q.x * q.y - q.z * q.w),
                         k * (q.x * q.z + q.y * q.w)};
    map.linear.row[1] = {k * (q.x * q.y + q.z * q.w), 1 - k * (q.x * q.x + q.z * q.z),
                         k * (q.y * q.z - q.x * q.w)};
    map.linear.row[2] = {k * (q.x * q.z - q.y * q.w), k * (q.y * q.z + q.x * q.w),
                         1 - k * (q.x * q.x + q.y * q.y)};
    for (Vec3d& row : map.linear.row) row = {row.x * scale.x, row.y * scale.y, row.z * scale.z};
    map.translation = translation;
    return map;
}

// Between two unit quaternions at constant speed along the shorter way (glTF 2.0, appendix C.4); t in [0, 1].
inline Quaternion slerp(const Quaternion& a, const Quaternion& b, double t) {
    const double cosine = dot(a, b);
    const double sign = cosine < 0 ? -1 : 1;
    const double angle = std::acos(std::fmin(std::fabs(cosine), 1.0));
    const double sine = std::sin(angle);
    double of_a = 1 - t, of_b = t; // where the ends meet, the chord is the arc
    if (sine > 1e-6) {
        of_a = std::sin(of_a * angle) / sine;
        of_b = std::sin(of_b * angle) / sine;
    }
    of_b *= sign;
    return normalize(
        {of_a * a.x + of_b * b.x, of_a * a.y + of_b * b.y, of_a * a.z + of_b * b.z, of_a * a.w + of_b * b.w});
}

} // namespace spa
