// SPDX-License-Identifier: Apache-2.0
// Affine maps of space in double precision: where nodes, cameras and instances stand.
#pragma once

#include "vector.h"

#include <cmath>

namespace spa {

// p -> linear * p + translation. The default is the identity.
struct Affine {
    Mat3 linear;
    Vec3d translation;
    friend constexpr bool operator==(const Affine&, const Affine&) = default;
};

constexpr Vec3d transform_point(const Affine& map, Vec3d point) {
    return map.linear * point + map.translation;
}
// A difference of points: the translation does not count.
constexpr Vec3d transform_vector(const Affine& map, Vec3d vector) { return map.linear * vector; }

inline bool is_finite(const Affine& map) {
    return is_finite(map.translation) && is_finite(map.linear.row[0]) && is_finite(map.linear.row[1]) &&
           is_finite(map.linear.row[2]);
}

// First b, then a.
constexpr Affine operator*(const Affine& a, const Affine& b) {
    return {a.linear * b.linear, transform_point(a, b.translation)};
}

// Whether inverse() makes sense: finite, and the axes not closer to a plane than the container allows a
// frame's to be (formats/SPA.md, section 5).
inline bool has_inverse(const Affine& map) {
    const Mat3& m = map.linear;
    const double lengths = length(m.row[0]) * length(m.row[1]) * length(m.row[2]);
    return is_finite(map) && lengths > 0 && std::abs(determinant(m)) > 1e-12 * lengths;
}

// The caller makes sure that the determinant of the linear part is not zero.
constexpr Affine inverse(const Affine& map) {
    const Mat3 linear = inverse(map.linear);
    return {linear, -(linear * map.translation)};
}

// A multiple of the inverse transpose with the same sign: carries normals. Exists for singular maps too,
// unlike the inverse.
constexpr Mat3 normal_matrix(const Mat3& m) {
    const double sign = determinant(m) < 0 ? -1.0 : 1.0;
    return {{cross(m.row[1], m.row[2]) * sign, cross(m.row[2], m.row[0]) * sign,
             cross(m.row[0], m.row[1]) * sign}};
}

} // namespace spa
