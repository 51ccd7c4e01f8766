// SPDX-License-Identifier: Apache-2.0
#include "map_surface.h"

#include <array>

namespace spa::measure {
namespace {

class Builder {
public:
    Builder(const Grid& grid, std::span<const double> depth, std::uint32_t base, MapSurface& surface)
        : grid_(grid), depth_(depth), base_(base), surface_(surface) {}

    void triangle(TexelIndex a, TexelIndex b, TexelIndex c) {
        std::array<std::uint32_t, 3> covered{};
        unsigned count = 0;
        for (const TexelIndex t : {a, b, c}) {
            const std::uint32_t i = t.y * grid_.width + t.x;
            if (depth_[i] > 0) covered[count++] = base_ + i;
        }
        if (count == 0) return;
        if (count < 3) covered[2] = covered[count - 1];
        if (count < 2) covered[1] = covered[0];
        surface_.triangles.push_back({covered});
    }

    // Corners in the order of their rows: a b over c d.
    void cell(TexelIndex a, TexelIndex b, TexelIndex c, TexelIndex d, bool falling_diagonal) {
        if (falling_diagonal) {
            triangle(a, d, b);
            triangle(a, c, d);
        } else {
            triangle(a, c, b);
            triangle(b, c, d);
        }
    }

private:
    const Grid& grid_;
    std::span<const double> depth_;
    std::uint32_t base_;
    MapSurface& surface_;
};

} // namespace

void append_surface(const Grid& grid, std::span<const double> depth, const Mat3& frame, MapSurface& surface) {
    const auto base = std::uint32_t(surface.positions.size());
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const Vec3d u = normalize(sample_direction(grid, {x, y}));
            surface.positions.push_back(to_float(frame * u * depth[std::size_t(y) * grid.width + x]));
        }
    }
    Builder builder(grid, depth, base, surface);
    if (grid.mapping == Mapping::octahedral) {
        const std::uint32_t half = grid.width / 2;
        for (std::uint32_t y = 0; y + 1 < grid.height; ++y) {
            for (std::uint32_t x = 0; x + 1 < grid.width; ++x) {
                // |s| + |t| = const falls to the right in the upper right and the lower left quadrant.
                const bool falling = (x >= half) == (y < half);
                builder.cell({x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}, falling);
            }
        }
        return;
    }
    for (std::uint32_t x = 0; x < grid.width; ++x) {
        const std::uint32_t next = (x + 1) % grid.width;
        for (std::uint32_t y = 0; y + 1 < grid.height; ++y)
            builder.cell({x, y}, {next, y}, {x, y + 1}, {next, y + 1}, false);
        if (x == 0 || next == 0) continue;
        builder.triangle({0, 0}, {x, 0}, {next, 0});
        builder.triangle({0, grid.height - 1}, {next, grid.height - 1}, {x, grid.height - 1});
    }
}

} // namespace spa::measure
