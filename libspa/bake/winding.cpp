// SPDX-License-Identifier: Apache-2.0
#include "winding.h"

#include "intervals.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace spa::bake {
namespace {

// Of the whole sphere, seen from the origin: positive if the corners go round counter-clockwise from outside.
double share_of_sphere(Vec3d a, Vec3d b, Vec3d c) {
    const double determinant = dot(a, cross(b, c));
    if (determinant == 0) return 0; // seen edge-on
    const Vec3d middle = (a + b + c) * (1.0 / 3);
    const double squared = dot(middle, middle);
    // Most triangles of a dense mesh look so small that they are as good as a point with their area: off by
    // less than the square of this angle.
    constexpr double small = 1e-2;
    if (std::max(dot(b - a, b - a), dot(c - a, c - a)) < small * small * squared)
        return determinant / (8 * std::numbers::pi * squared * std::sqrt(squared));
    const double la = length(a), lb = length(b), lc = length(c);
    const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return std::atan2(determinant, denominator) / (2 * std::numbers::pi);
}

// Sums of integers do not depend on their order. They may wrap on the way: what counts is that the total does
// not, and that is a small number.
constexpr double fixed_one = 0x1p40;

std::uint64_t to_fixed(double value) { return std::uint64_t(std::int64_t(value * fixed_one)); }

} // namespace

void WindingNumbers::Run::add(std::size_t triangle, Vec3d a, Vec3d b, Vec3d c) {
    const std::uint32_t component = numbers_.components_.of_triangle[triangle];
    if (component != component_) flush();
    component_ = component;
    const double share = share_of_sphere(a, b, c);
    sum_ += to_fixed(numbers_.components_.is_turned(std::uint32_t(triangle)) ? -share : share);
}

void WindingNumbers::Run::flush() {
    std::atomic_ref(numbers_.sums_[component_]).fetch_add(sum_, std::memory_order_relaxed);
    sum_ = 0;
}

bool WindingNumbers::any_solid() const {
    return std::any_of(sums_.begin(), sums_.end(), [](std::uint64_t sum) {
        return std::abs(double(std::int64_t(sum))) > solid_winding * fixed_one;
    });
}

} // namespace spa::bake
