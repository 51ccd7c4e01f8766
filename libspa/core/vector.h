// SPDX-License-Identifier: Apache-2.0
// Small fixed-size vectors and matrices: plain aggregates, no invariants, everything constexpr.
#pragma once

#include <cmath>

namespace spa {

template <class T>
struct Vec2 {
    T x{}, y{};
    friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

template <class T>
struct Vec3 {
    T x{}, y{}, z{};
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

template <class T>
struct Vec4 {
    T x{}, y{}, z{}, w{};
    friend constexpr bool operator==(const Vec4&, const Vec4&) = default;
};

using Vec2f = Vec2<float>;
using Vec2d = Vec2<double>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Vec4f = Vec4<float>;

template <class T>
constexpr Vec2<T> operator+(Vec2<T> a, Vec2<T> b) {
    return {a.x + b.x, a.y + b.y};
}
template <class T>
constexpr Vec2<T> operator-(Vec2<T> a, Vec2<T> b) {
    return {a.x - b.x, a.y - b.y};
}
template <class T>
constexpr Vec2<T> operator*(Vec2<T> a, T s) {
    return {a.x * s, a.y * s};
}
template <class T>
constexpr Vec3<T> operator+(Vec3<T> a, Vec3<T> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
constexpr Vec3<T> operator-(Vec3<T> a, Vec3<T> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
constexpr Vec3<T> operator-(Vec3<T> a) {
    return {-a.x, -a.y, -a.z};
}
template <class T>
constexpr Vec3<T> operator*(Vec3<T> a, T s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <class T>
constexpr T dot(Vec3<T> a, Vec3<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(Vec3<T> a) {
    return std::sqrt(dot(a, a));
}
// The zero vector (and one too short to normalise) gives the zero vector, never NaN.
template <class T>
Vec3<T> normalize(Vec3<T> a) {
    const T len = length(a);
    return len > T(0) ? a * (T(1) / len) : Vec3<T>{};
}
template <class T>
bool is_finite(Vec3<T> a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

constexpr Vec3d to_double(Vec3f a) { return {double(a.x), double(a.y), double(a.z)}; }
constexpr Vec3f to_float(Vec3d a) { return {float(a.x), float(a.y), float(a.z)}; }

// Row-major 3x3 matrix: row[i] dot v is component i of M v.
struct Mat3 {
    Vec3d row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    friend constexpr bool operator==(const Mat3&, const Mat3&) = default;
};

constexpr Vec3d operator*(const Mat3& m, Vec3d v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
constexpr Mat3 transpose(const Mat3& m) {
    return {{{m.row[0].x, m.row[1].x, m.row[2].x},
             {m.row[0].y, m.row[1].y, m.row[2].y},
             {m.row[0].z, m.row[1].z, m.row[2].z}}};
}
// First b, then a.
constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
    const Mat3 columns = transpose(b);
    Mat3 out;
    for (int i = 0; i < 3; ++i)
        out.row[i] = {dot(a.row[i], columns.row[0]), dot(a.row[i], columns.row[1]),
                      dot(a.row[i], columns.row[2])};
    return out;
}
constexpr double determinant(const Mat3& m) { return dot(m.row[0], cross(m.row[1], m.row[2])); }
// Inverse by cofactors. The caller makes sure that the determinant is not zero.
constexpr Mat3 inverse(const Mat3& m) {
    const double s = 1.0 / determinant(m);
    return transpose(
        {{cross(m.row[1], m.row[2]) * s, cross(m.row[2], m.row[0]) * s, cross(m.row[0], m.row[1]) * s}});
}

} // namespace spa
