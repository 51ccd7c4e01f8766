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
        column_a_.reserve(grid.width + column_padding);
        row_.reserve(grid.height);
        if (octahedral_) {
            const auto n = std::int64_t(grid.width) - 1;
            for (std::int64_t i = 0; i <= n; ++i) {
                column_a_.push_back(double(2 * i - n) / double(n));
                row_.push_back({double(n - 2 * i) / double(n), 0});
            }
        } else {
            constexpr double pi = std::numbers::pi;
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const double phi = 2 * pi * (double(x) + 0.5) / grid.width - pi;
                column_a_.push_back(std::sin(phi));
                column_b_.push_back(std::cos(phi));
            }
            for (std::uint32_t y = 0; y < grid.height; ++y) {
                const double theta = pi * (double(y) + 0.5) / grid.height;
                row_.push_back({std::sin(theta), std::cos(theta)});
                row_angle_.push_back(solid_angle(grid, {0, y}));
            }
        }
        column_a_.resize(grid.width + column_padding);
        column_b_.resize(grid.width + column_padding);
    }

    [[nodiscard]] Vec3d operator()(std::uint32_t x, std::uint32_t y) const {
        return octahedral_ ? octahedral_direction(column_a_[x], row_[y].x)
                           : latlong_direction({column_a_[x], column_b_[x]}, row_[y]);
    }

    // For loops over a row: the direction of sample (x, y) is octahedral_direction(columns_a()[x], row(y).x)
    // or latlong_direction({columns_a()[x], columns_b()[x]}, row(y)). Behind the last column there are
    // column_padding more values, which mean nothing, for loops that take several columns at a time.
    static constexpr std::uint32_t column_padding = 4;
    [[nodiscard]] bool octahedral() const { return octahedral_; }
    [[nodiscard]] const double* columns_a() const { return column_a_.data(); }
    [[nodiscard]] const double* columns_b() const { return column_b_.data(); }
    [[nodiscard]] Vec2d row(std::uint32_t y) const { return row_[y]; }

    // Without branches, so that loops over samples can be vectorised.
    static Vec3d octahedral_direction(double s, double t) {
        const double z = 1 - (std::abs(s) + std::abs(t));
        const double folded_s = std::copysign(1 - std::abs(t), s);
        const double folded_t = std::copysign(1 - std::abs(s), t);
        return {(z >= 0 ? s : folded_s) + 0.0, (z >= 0 ? t : folded_t) + 0.0, z};
    }
    // x = sine, y = cosine of phi and of theta.
    static Vec3d latlong_direction(Vec2d phi, Vec2d theta) {
        return {theta.x * phi.x, theta.y, theta.x * phi.y};
    }

    [[nodiscard]] double solid_angle_of(TexelIndex at) const {
        return octahedral_ ? solid_angle(grid_, at) : row_angle_[at.y];
    }

private:
    Grid grid_;
    bool octahedral_;
    // octahedral: s of a column, x = t of a row. latlong: sine and cosine of phi or theta.
    std::vector<double> column_a_, column_b_;
    std::vector<Vec2d> row_;
    std::vector<double> row_angle_; // latlong: the same for all samples of a row
};

} // namespace spa::bake
