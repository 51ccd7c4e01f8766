// SPDX-License-Identifier: Apache-2.0
// What the two halves of the judge share: octants, and which cells of one a coordinate touches.
#pragma once

#include "../../libspa/core/vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace spa::test {

inline Vec3d octant_signs(unsigned octant) {
    return {octant & 1U ? -1.0 : 1.0, octant & 2U ? -1.0 : 1.0, octant & 4U ? -1.0 : 1.0};
}

// The cells of a row of n that a coordinate moving from x to y, in [0, 1] but for rounding, may touch.
struct CellRange {
    std::uint32_t first = 0, last = 0;
};
inline CellRange cells_between(double x, double y, std::uint32_t n) {
    const auto cell = [n](double v) {
        return std::uint32_t(std::clamp(std::floor(v * n), 0.0, double(n) - 1));
    };
    constexpr double margin = 1e-6;
    return {cell(std::min(x, y) - margin), cell(std::max(x, y) + margin)};
}

} // namespace spa::test
