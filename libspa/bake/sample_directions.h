// SPDX-License-Identifier: Apache-2.0
// Directions and solid angles of a grid's samples from tables: the same bits as spa::sample_direction and
// spa::solid_angle, without their divisions and trigonometry.
#pragma once

#include "../core/direction_map.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace spa::bake {

class SampleDirections {
public:
    explicit SampleDirections(const Grid& grid)
        : grid_(grid), octahedral_(grid.mapping == Mapping::octahedral) {
        column_.reserve(grid.width);
        row_.reserve(grid.height);
        if (octahedral_) {
            const auto n = std::int64_t(grid.width) - 1;
            for (std::int64_t i = 0; i <= n; ++i) {
                column_.push_back({double(2 * i - n) / double(n), 0});
                row_.push_back({double(n - 2 * i) / double(n), 0});
            }
        } else {
            constexpr double pi = std::numbers::pi;
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const double phi = 2 * pi * (double(x) + 0.5) / grid.width - pi;
                column_.push_back({std::sin(phi), std::cos(phi)});
            }
            for (std::uint32_t y = 0; y < grid.height; ++y) {
                const double theta = pi * (double(y) + 0.5) / grid.height;
                row_.push_back({std::sin(theta), std::cos(theta)});
                row_angle_.push_back(solid_angle(grid, {0, y}));
            }
        }
    }

    [[nodiscard]] Vec3d operator()(std::uint32_t x, std::uint32_t y) const {
        if (!octahedral_) {
            return {row_[y].x * column_[x].x, row_[y].y, row_[y].x * column_[x].y};
        }
        const double s = column_[x].x;
        const double t = row_[y].x;
        const double z = 1 - (std::abs(s) + std::abs(t));
        if (z >= 0) return {s + 0.0, t + 0.0, z};
        return {std::copysign(1 - std::abs(t), s) + 0.0, std::copysign(1 - std::abs(s), t) + 0.0, z};
    }

    [[nodiscard]] double solid_angle_of(TexelIndex at) const {
        return octahedral_ ? solid_angle(grid_, at) : row_angle_[at.y];
    }

private:
    Grid grid_;
    bool octahedral_;
    // octahedral: x = s or t; latlong: sine and cosine of phi or theta.
    std::vector<Vec2d> column_, row_;
    std::vector<double> row_angle_; // latlong: the same for all samples of a row
};

} // namespace spa::bake
