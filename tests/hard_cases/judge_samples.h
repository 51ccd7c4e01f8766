// SPDX-License-Identifier: Apache-2.0
// What the judge reads of a part: the intervals of each sample, and which samples make which triangle.
#pragma once

#include "../../libspa/core/spherical_map.h"

#include <array>
#include <cstdint>
#include <vector>

namespace spa::test {

struct StoredInterval {
    double outer = 0, inner = 0;      // W; inner 0: reaches the centre
    Vec3d outer_normal, inner_normal; // zero: none
};

class StoredSamples {
public:
    // layers: as many of the part's layers at most; 0: all.
    StoredSamples(const Part& part, std::uint32_t layers);

    [[nodiscard]] std::uint32_t cells() const { return grid_.width - 1; } // N
    // |g|_1 = 1.
    [[nodiscard]] Vec3d direction(TexelIndex at) const { return sample_direction(grid_, at); }
    [[nodiscard]] const std::vector<StoredInterval>& intervals(TexelIndex at) const {
        return intervals_[std::size_t(at.y) * grid_.width + at.x];
    }
    // Triangle f of cell (x, y).
    [[nodiscard]] bool marked_mixed(std::uint32_t x, std::uint32_t y, std::uint32_t f) const;
    [[nodiscard]] bool center_inside() const { return center_inside_; }

private:
    Grid grid_;
    std::vector<std::vector<StoredInterval>> intervals_;
    std::vector<std::byte> mixed_;
    bool center_inside_ = false;
};

// The corners of a triangle of cell (x, y): f = 0 the one at the cell's corner nearest to the middle of the
// map, f = 1 the other; then the ends of the diagonal, first the one in the column of the nearest corner.
struct GridTriangle {
    std::array<TexelIndex, 3> corners;
};
GridTriangle grid_triangle(std::uint32_t cells, std::uint32_t x, std::uint32_t y, std::uint32_t f);

// p/|p|_1 has the barycentric coordinates form . p / |p|_1 in the triangle of three directions with |g|_1
// = 1.
struct Barycentric {
    std::array<Vec3d, 3> form;
    Barycentric(Vec3d a, Vec3d b, Vec3d c);
};

} // namespace spa::test
