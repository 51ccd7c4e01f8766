// SPDX-License-Identifier: Apache-2.0
// How a mixed triangle with folds is divided (docs/tracing.md, "Mixed triangles with folds"): for the judge,
// from that text alone. Sheets are found by following matches, regions by trying every choice of sides of
// the lines; places are whole 256ths of an edge, so that what is on which side of a line is exact.
#pragma once

#include "judge_samples.h"

#include "../../libspa/core/folds.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace spa::test {

// A triangle and what its edges' records say.
struct FoldTriangle {
    struct Edge {
        std::array<unsigned, 2> corner{}; // which of the triangle's are the edge's ends 0 and 1
        std::span<const FoldRecord> records;
    };
    std::array<Vec3d, 3> directions; // |g|_1 = 1
    std::array<std::vector<StoredInterval>, 3> intervals;
    std::array<Edge, 3> edges;
    bool center_inside = false;
};

constexpr unsigned most_fold_lines = 5;

// A convex part of a triangle: p with sides[k] . p >= 0 for all k.
struct FoldRegion {
    struct Interval {
        Vec3d outer, inner;     // the ends are the points with outer . p = 1, inner . p = 1
        bool to_center = false; // there is no inner end
        std::size_t layer = 0, inner_layer = 0;
        std::optional<std::size_t> open; // the side at which its wall is open
    };
    std::vector<Vec3d> sides;
    std::vector<Vec3d> corners;      // |g|_1 = 1
    std::vector<Interval> intervals; // from outside
};

// Nothing: one of the steps fails.
std::optional<std::vector<FoldRegion>> divide(const FoldTriangle& triangle);

// The records of a part by edge, in their order.
class FoldTable {
public:
    explicit FoldTable(std::span<const std::byte> folds);
    [[nodiscard]] bool empty() const { return records_.empty(); }
    // at: the corners of a triangle. corners: as `triangle.corners` of grid_triangle().
    [[nodiscard]] std::array<FoldTriangle::Edge, 3> edges(std::uint32_t cells, TexelIndex cell,
                                                          const GridTriangle& triangle) const;

private:
    std::vector<FoldRecord> records_;
};

} // namespace spa::test
