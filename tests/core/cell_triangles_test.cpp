// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/cell_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace spa {
namespace {

// The sign of a coordinate over a triangle: 0 if the corners differ.
int side(double a, double b, double c) {
    if (a >= 0 && b >= 0 && c >= 0) return 1;
    return a <= 0 && b <= 0 && c <= 0 ? -1 : 0;
}

TEST(CellTriangles, EachLiesInOneOctant) {
    for (const std::uint32_t cells : {2U, 4U, 6U, 34U}) {
        const Grid grid{Mapping::octahedral, cells + 1, cells + 1};
        for (std::uint32_t y = 0; y < cells; ++y) {
            for (std::uint32_t x = 0; x < cells; ++x) {
                for (const unsigned triangle : {0U, 1U}) {
                    const auto corners = triangle_corners(cells, x, y, triangle);
                    const Vec3d a = sample_direction(grid, corners[0]);
                    const Vec3d b = sample_direction(grid, corners[1]);
                    const Vec3d c = sample_direction(grid, corners[2]);
                    EXPECT_NE(side(a.x, b.x, c.x) * side(a.y, b.y, c.y) * side(a.z, b.z, c.z), 0)
                        << cells << " " << x << " " << y << " " << triangle;
                    // An octant is a plane: a triangle in it has the area that it has in the map.
                    const double area = length(cross(b - a, c - a)) / 2;
                    EXPECT_NEAR(area, std::sqrt(3.0) * 2 / cells / cells, 1e-12);
                }
            }
        }
    }
}

TEST(CellTriangles, TheFirstHasTheCornerNearestToTheMiddle) {
    const auto distance = [](TexelIndex t) { return std::hypot(double(t.x) - 3, double(t.y) - 3); };
    for (std::uint32_t y = 0; y < 6; ++y) {
        for (std::uint32_t x = 0; x < 6; ++x) {
            const auto first = triangle_corners(6, x, y, 0), second = triangle_corners(6, x, y, 1);
            for (const std::uint32_t i : {1U, 2U}) {
                EXPECT_EQ(first[i], second[i]);
                EXPECT_LT(distance(first[0]), distance(first[i]));
                EXPECT_GT(distance(second[0]), distance(first[i]));
            }
        }
    }
}

TEST(CellTriangles, BitsAreNumberedCellByCell) {
    EXPECT_EQ(mixed_bytes(2), 1U);
    EXPECT_EQ(mixed_bytes(6), 9U);
    EXPECT_EQ(mixed_bytes(256), 16384U);
    EXPECT_EQ(triangle_bit(6, 0, 0, 1), 1U);
    EXPECT_EQ(triangle_bit(6, 5, 5, 1), 8 * mixed_bytes(6) - 1);
    EXPECT_EQ(triangle_bit(65536, 65535, 65535, 1), (std::uint64_t(1) << 33U) - 1);
    std::vector<std::byte> bits(9);
    bits[1] = std::byte{0x12};
    for (std::uint64_t i = 0; i < 72; ++i) EXPECT_EQ(is_mixed(bits, i), i == 9 || i == 12);
    EXPECT_DOUBLE_EQ(mixed_share(bits), 2.0 / 72);
    EXPECT_EQ(mixed_share({}), 0);
}

} // namespace
} // namespace spa
