// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/folds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

namespace spa {
namespace {

constexpr std::uint32_t some_cells[] = {2, 4, 6, 10};

// Calls visit(x, y, triangle).
template <class Visit>
void each_triangle(std::uint32_t cells, Visit visit) {
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x)
            for (const unsigned triangle : {0U, 1U}) visit(x, y, triangle);
}

TEST(Folds, EdgesOfATriangleJoinItsCorners) {
    for (const std::uint32_t cells : some_cells) {
        each_triangle(cells, [&](std::uint32_t x, std::uint32_t y, unsigned triangle) {
            const std::array<TexelIndex, 3> corners = triangle_corners(cells, x, y, triangle);
            const std::array<TriangleEdge, 3> edges = triangle_edges(cells, x, y, triangle);
            for (unsigned i = 0; i < 3; ++i) {
                const auto [edge, corner] = edges[i];
                EXPECT_TRUE(is_edge(cells, edge));
                // Opposite to corner i: the other two, in the order in which the edge has them.
                EXPECT_EQ(corner[0] + corner[1] + i, 3U);
                EXPECT_NE(corner[0], corner[1]);
                EXPECT_NE(corner[0], i);
                EXPECT_NE(corner[1], i);
                const std::array<TexelIndex, 2> ends = edge_ends(cells, edge);
                EXPECT_EQ(ends[0], corners[corner[0]]) << cells << " " << x << " " << y << " " << triangle;
                EXPECT_EQ(ends[1], corners[corner[1]]) << cells << " " << x << " " << y << " " << triangle;
            }
        });
    }
}

// N cells a side have N (N + 1) edges of either straight kind and N^2 diagonals, each of two triangles but
// those of the border.
TEST(Folds, EdgesAreNumberedOnce) {
    for (const std::uint32_t cells : some_cells) {
        std::vector<unsigned> triangles(edge_count(cells));
        each_triangle(cells, [&](std::uint32_t x, std::uint32_t y, unsigned triangle) {
            for (const TriangleEdge& e : triangle_edges(cells, x, y, triangle)) ++triangles.at(e.edge);
        });
        std::set<std::pair<std::size_t, std::size_t>> joined;
        const auto sample = [&](TexelIndex t) { return std::size_t(t.y) * (cells + 1) + t.x; };
        for (std::uint32_t edge = 0; edge < edge_count(cells); ++edge) {
            EXPECT_EQ(is_edge(cells, edge), triangles[edge] != 0) << cells << " " << edge;
            if (!is_edge(cells, edge)) continue;
            const std::array<TexelIndex, 2> ends = edge_ends(cells, edge);
            EXPECT_LE(std::max({ends[0].x, ends[0].y, ends[1].x, ends[1].y}), cells);
            joined.insert(std::minmax(sample(ends[0]), sample(ends[1])));
        }
        EXPECT_EQ(joined.size(), 2 * cells * (cells + 1) + cells * cells);
        EXPECT_EQ(std::count(triangles.begin(), triangles.end(), 1U), 4 * cells);
        EXPECT_EQ(*std::max_element(triangles.begin(), triangles.end()), 2U);
    }
}

// The text of the specification for one grid, number by number.
TEST(Folds, EdgesHaveTheNumbersOfTheSpecification) {
    constexpr std::uint32_t cells = 4;
    using Ends = std::array<TexelIndex, 2>;
    EXPECT_EQ(edge_count(cells), 75U);
    EXPECT_EQ(edge_number(cells, {2, 3}, 1), 52U);
    EXPECT_EQ(edge_ends(cells, 51), (Ends{TexelIndex{2, 3}, TexelIndex{3, 3}}));
    EXPECT_EQ(edge_ends(cells, 52), (Ends{TexelIndex{2, 3}, TexelIndex{2, 4}}));
    // Diagonals of the four quadrants: from the nearest column and the farthest row.
    EXPECT_EQ(edge_ends(cells, 3 * 6 + 2), (Ends{TexelIndex{2, 1}, TexelIndex{1, 2}}));
    EXPECT_EQ(edge_ends(cells, 3 * 7 + 2), (Ends{TexelIndex{2, 1}, TexelIndex{3, 2}}));
    EXPECT_EQ(edge_ends(cells, 3 * 11 + 2), (Ends{TexelIndex{2, 3}, TexelIndex{1, 2}}));
    EXPECT_EQ(edge_ends(cells, 3 * 12 + 2), (Ends{TexelIndex{2, 3}, TexelIndex{3, 2}}));
    // Column 4 has edges down only, row 4 edges to the right only.
    EXPECT_FALSE(is_edge(cells, edge_number(cells, {4, 1}, 0)));
    EXPECT_TRUE(is_edge(cells, edge_number(cells, {4, 1}, 1)));
    EXPECT_FALSE(is_edge(cells, edge_number(cells, {4, 1}, 2)));
    EXPECT_TRUE(is_edge(cells, edge_number(cells, {1, 4}, 0)));
    EXPECT_FALSE(is_edge(cells, edge_number(cells, {1, 4}, 1)));
    EXPECT_FALSE(is_edge(cells, edge_number(cells, {1, 4}, 2)));
    for (const unsigned kind : {0U, 1U, 2U}) EXPECT_FALSE(is_edge(cells, edge_number(cells, {4, 4}, kind)));
    for (std::uint32_t beyond = 75; beyond < 100; ++beyond) EXPECT_FALSE(is_edge(cells, beyond));
    EXPECT_FALSE(is_edge(cells, 0xFFFFFFFF));
    // The last edge of the largest map.
    const std::uint32_t last =
        edge_number(most_numbered_cells, {most_numbered_cells - 1, most_numbered_cells}, 0);
    EXPECT_TRUE(is_edge(most_numbered_cells, last));
    EXPECT_EQ(last, 805404669U);
    EXPECT_EQ(most_fold_bytes(4), 75U * 640);
}

TEST(Folds, PositionsReachTheOtherEndAndNeverThisOne) {
    EXPECT_EQ(fold_position(0), 1.0 / 256);
    EXPECT_EQ(fold_position(127), 0.5);
    EXPECT_EQ(fold_position(255), 1);
}

TEST(Folds, BytesLieInPlanes) {
    const std::vector<FoldRecord> records{{0x01020304, true, 1, 5, 0xAB, {0x1122, 0x3344}},
                                          {0x01020304, false, 0, 63, 7, {0x5566, 0}}};
    const std::vector<unsigned> expected{0x04, 0, 0x03, 0,    0x02, 0,    0x01, 0,    0xC5, 0x3F,
                                         0xAB, 7, 0x22, 0x66, 0x11, 0x55, 0x44, 0x00, 0x33, 0x00};
    const std::vector<std::byte> bytes = encode_folds(records);
    ASSERT_EQ(bytes.size(), expected.size());
    for (std::size_t i = 0; i < bytes.size(); ++i)
        EXPECT_EQ(std::to_integer<unsigned>(bytes[i]), expected[i]) << i;
}

TEST(Folds, WhatIsEncodedIsDecoded) {
    std::mt19937 random(1);
    for (const std::size_t count : {0U, 1U, 2U, 300U}) {
        std::vector<FoldRecord> records(count);
        std::uint32_t edge = 0;
        for (FoldRecord& r : records) {
            edge += std::uint32_t(random() >> (8 * (random() % 3) + 8)) / 256;
            r = {edge,
                 random() % 2 == 0,
                 std::uint8_t(random() % 2),
                 std::uint8_t(random() % fold_indices),
                 std::uint8_t(random()),
                 {std::uint16_t(random()), std::uint16_t(random())}};
        }
        const std::vector<std::byte> bytes = encode_folds(records);
        EXPECT_EQ(bytes.size(), fold_record_bytes * count);
        EXPECT_EQ(decode_folds(bytes), records);
        for (std::size_t i = 0; i < count; ++i) {
            FoldRecord step = records[i];
            step.edge -= i == 0 ? 0 : records[i - 1].edge;
            EXPECT_EQ(decode_fold_step(bytes, i), step);
        }
    }
}

// Whatever a file holds comes out as members in their ranges.
TEST(Folds, AnyBytesCanBeDecoded) {
    const std::vector<std::byte> bytes(3 * fold_record_bytes, std::byte{0xFF});
    const std::vector<FoldRecord> records = decode_folds(bytes);
    ASSERT_EQ(records.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i)
        EXPECT_EQ(records[i], (FoldRecord{0xFFFFFFFF - i, true, 1, 63, 255, {65535, 65535}}));
}

} // namespace
} // namespace spa
