// SPDX-License-Identifier: Apache-2.0
// Affine maps of space in double precision.
#pragma once

#include "../../libspa/core/vector.h"

namespace spa::import {

struct Affine {
    Mat3 linear;
    Vec3d translation;
};

constexpr Vec3d transform_point(const Affine& map, Vec3d point) {
    return map.linear * point + map.translation;
}

constexpr Mat3 multiply(const Mat3& a, const Mat3& b) {
    const Mat3 columns = transpose(b);
    Mat3 out;
    for (int i = 0; i < 3; ++i)
        out.row[i] = {dot(a.row[i], columns.row[0]), dot(a.row[i], columns.row[1]),
                      dot(a.row[i], columns.row[2])};
    return out;
}

// First b, then a.
constexpr Affine operator*(const Affine& a, const Affine& b) {
    return {multiply(a.linear, b.linear), transform_point(a, b.translation)};
}

// A multiple of the inverse transpose with the same sign: carries normals. Exists for singular maps too,
// unlike the inverse.
constexpr Mat3 normal_matrix(const Mat3& m) {
    const double sign = determinant(m) < 0 ? -1.0 : 1.0;
    return {{cross(m.row[1], m.row[2]) * sign, cross(m.row[2], m.row[0]) * sign,
             cross(m.row[0], m.row[1]) * sign}};
}

} // namespace spa::import
