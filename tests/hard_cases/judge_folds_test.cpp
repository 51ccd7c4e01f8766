// SPDX-License-Identifier: Apache-2.0
// How the judge divides triangles with folds, against divisions that can be written down. In the octant of
// the directions x, y, z barycentric coordinates are those of the point over |p|_1.
#include "fold_maps.h"
#include "judge.h"
#include "judge_folds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>

namespace {

using namespace spa;
using namespace spa::test;
using trace::HitSide;

// A code of a depth at which W is `w`, and back: codes round.
std::uint16_t code_of(Vec3d g, double w) { return std::uint16_t(std::lround(length(g) * 65535 / w)); }
double w_of(Vec3d g, std::uint16_t code) { return length(g) * 65535 / code; }

using Intervals = std::vector<StoredInterval>;

// The octant with corners x, y, z; its edges are xy, yz, zx.
struct Octant {
    FoldTriangle triangle;
    std::array<std::vector<FoldRecord>, 3> records;

    Octant(const Intervals& x, const Intervals& y, const Intervals& z, bool center_inside = false) {
        triangle.directions = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
        triangle.intervals = {x, y, z};
        triangle.center_inside = center_inside;
    }
    // Of corner i towards corner j, at `steps` of 256.
    void record(unsigned i, unsigned j, bool pair, unsigned index, unsigned steps, double w,
                double second = 0) {
        const unsigned edge = i == (j + 1) % 3 ? j : i;
        const Vec3d g =
            triangle.directions[i] * (1 - steps / 256.0) + triangle.directions[j] * (steps / 256.0);
        records[edge].push_back({edge,
                                 pair,
                                 std::uint8_t(edge == i ? 0 : 1),
                                 std::uint8_t(index),
                                 std::uint8_t(steps - 1),
                                 {code_of(g, w), pair ? code_of(g, second) : std::uint16_t(0)}});
    }
    [[nodiscard]] std::optional<std::vector<FoldRegion>> divided() {
        for (unsigned i = 0; i < 3; ++i) triangle.edges[i] = {{i, (i + 1) % 3}, records[i]};
        return divide(triangle);
    }
};

// The region that a point of the triangle is in.
const FoldRegion& region_at(const std::vector<FoldRegion>& regions, Vec3d point) {
    const FoldRegion* found = nullptr;
    for (const FoldRegion& region : regions) {
        bool inside = true;
        for (const Vec3d& side : region.sides) inside = inside && dot(side, point) > 0;
        if (!inside) continue;
        EXPECT_EQ(found, nullptr) << "regions overlap";
        found = &region;
    }
    EXPECT_NE(found, nullptr);
    return *found;
}

StoredInterval slab(double outer, double inner) { return {outer, inner, {}, {}}; }

TEST(JudgeFolds, OneCornerIsCutOff) {
    // A shell at x alone, in front of a ball; it ends half way to y and a quarter of the way to z.
    Octant octant({slab(1, 2), slab(4, 0)}, {slab(4, 0)}, {slab(4, 0)});
    octant.record(0, 1, true, 0, 128, 1.5, 1.6);
    octant.record(0, 2, true, 0, 64, 1.4, 1.7);
    const auto regions = octant.divided();
    ASSERT_TRUE(regions.has_value());
    ASSERT_EQ(regions->size(), 2U);
    // The line is y/0.5 + z/0.25 = 1.
    const Vec3d near{0.8, 0.1, 0.1};
    const FoldRegion& own = region_at(*regions, near);
    ASSERT_EQ(own.intervals.size(), 2U);
    EXPECT_NEAR(dot(own.intervals[0].outer, near), 1 + 0.1 * 0.5 / 0.5 + 0.1 * 0.4 / 0.25, 1e-4);
    EXPECT_NEAR(dot(own.intervals[0].inner, near), 2 - 0.1 * 0.4 / 0.5 - 0.1 * 0.3 / 0.25, 1e-4);
    EXPECT_FALSE(own.intervals[0].to_center);
    EXPECT_TRUE(own.intervals[1].to_center);
    EXPECT_NEAR(dot(own.intervals[1].outer, near), 4, 1e-12);
    EXPECT_EQ(own.intervals[1].layer, 1U) << "that of the ball at x, its first corner";
    EXPECT_EQ(region_at(*regions, {0.74, 0.13, 0.13}).intervals.size(), 2U);
    EXPECT_EQ(region_at(*regions, {0.63, 0.19, 0.18}).intervals.size(), 1U);
    EXPECT_EQ(region_at(*regions, {0.1, 0.1, 0.8}).intervals.size(), 1U);
}

TEST(JudgeFolds, TwoCornersAreKept) {
    // The shell stands at x and y and ends half way to z.
    Octant octant({slab(1, 2), slab(4, 0)}, {slab(1.2, 2), slab(4, 0)}, {slab(4, 0)});
    octant.record(0, 2, true, 0, 128, 1.5, 1.8);
    octant.record(1, 2, true, 0, 128, 1.6, 1.7);
    const auto regions = octant.divided();
    ASSERT_TRUE(regions.has_value());
    ASSERT_EQ(regions->size(), 2U);
    const Vec3d point{0.6, 0.2, 0.2};
    const FoldRegion& own = region_at(*regions, point);
    ASSERT_EQ(own.intervals.size(), 2U);
    // 1 at x, 1.2 at y, 1.55 at (0.25, 0.25, 0.5): 2 at z.
    EXPECT_NEAR(dot(own.intervals[0].outer, point), 0.6 + 0.24 + 0.2 * 2, 1e-4);
    EXPECT_EQ(region_at(*regions, {0.3, 0.21, 0.49}).intervals.size(), 2U);
    EXPECT_EQ(region_at(*regions, {0.3, 0.19, 0.51}).intervals.size(), 1U);
}

TEST(JudgeFolds, TwoLines) {
    const Intervals both{slab(1, 1.5), slab(2, 3), slab(4, 0)};
    const Intervals ball{slab(4, 0)};
    for (const unsigned steps : {64U, 128U, 200U}) {
        // Both shells of x end on different lines, which meet where the one is not behind the other.
        Octant octant(both, ball, ball);
        octant.record(0, 1, true, 0, 128, 1.2, 1.3);
        octant.record(0, 1, true, 0, steps, 2.4, 2.6);
        octant.record(0, 2, true, 0, 128, 1.2, 1.3);
        octant.record(0, 2, true, 0, 128, 2.4, 2.6);
        const auto regions = octant.divided();
        ASSERT_TRUE(regions.has_value());
        EXPECT_EQ(regions->size(), steps == 128 ? 2U : 3U) << "they meet on an edge, or are the same";
    }
    Octant crossing(both, ball, ball);
    crossing.record(0, 1, true, 0, 64, 1.2, 1.3);
    crossing.record(0, 1, true, 0, 192, 2.4, 2.6);
    crossing.record(0, 2, true, 0, 192, 1.2, 1.3);
    crossing.record(0, 2, true, 0, 64, 2.4, 2.6);
    const auto regions = crossing.divided();
    ASSERT_TRUE(regions.has_value());
    ASSERT_EQ(regions->size(), 4U);
    // y/0.25 + z/0.75 = 1 and y/0.75 + z/0.25 = 1 meet at y = z = 3/16.
    EXPECT_EQ(region_at(*regions, {0.64, 0.18, 0.18}).intervals.size(), 3U);
    EXPECT_EQ(region_at(*regions, {0.6, 0.2, 0.2}).intervals.size(), 1U);
    EXPECT_NEAR(dot(region_at(*regions, {0.6, 0.1, 0.3}).intervals[0].outer, Vec3d{1, 0, 0}), 1, 1e-9);
    EXPECT_NEAR(dot(region_at(*regions, {0.6, 0.3, 0.1}).intervals[0].outer, Vec3d{1, 0, 0}), 2, 1e-9);
}

TEST(JudgeFolds, LinesAtTheEnds) {
    const Intervals shell{slab(1, 2), slab(4, 0)};
    const Intervals ball{slab(4, 0)};
    Octant whole(shell, ball, ball);
    whole.record(0, 1, true, 0, 256, 1.5, 1.6);
    whole.record(0, 2, true, 0, 256, 1.5, 1.6);
    auto regions = whole.divided();
    ASSERT_TRUE(regions.has_value());
    ASSERT_EQ(regions->size(), 1U) << "the line is an edge";
    EXPECT_EQ(regions->front().intervals.size(), 2U);
    Octant pointed(shell, shell, ball);
    pointed.record(0, 2, true, 0, 256, 1.5, 1.6);
    pointed.record(1, 2, true, 0, 256, 1.3, 1.6);
    regions = pointed.divided();
    ASSERT_TRUE(regions.has_value());
    ASSERT_EQ(regions->size(), 1U) << "no line: both cuts are at z";
    EXPECT_NEAR(dot(regions->front().intervals[0].outer, Vec3d{0, 0, 1}), 1.4, 1e-4);
    // One of two corners on the line, which is an edge.
    Octant edge(shell, shell, ball);
    edge.record(0, 2, true, 0, 128, 1.5, 1.6);
    edge.record(1, 2, true, 0, 256, 1.5, 1.6);
    regions = edge.divided();
    ASSERT_TRUE(regions.has_value());
    ASSERT_EQ(regions->size(), 1U);
    EXPECT_EQ(regions->front().intervals.size(), 2U) << "on the side of x and y, though x is on the line";
}

TEST(JudgeFolds, GapsAndNests) {
    // A gap that closes before y and z.
    Octant gap({slab(1, 2), slab(3, 0)}, {slab(1, 0)}, {slab(1, 0)});
    gap.record(0, 1, true, 1, 128, 2.4, 2.6);
    gap.record(0, 2, true, 1, 128, 2.4, 2.6);
    auto regions = gap.divided();
    ASSERT_TRUE(regions.has_value());
    const FoldRegion& own = region_at(*regions, {0.6, 0.2, 0.2});
    ASSERT_EQ(own.intervals.size(), 2U);
    EXPECT_EQ(own.intervals[0].inner_layer, 0U);
    const FoldRegion& beyond = region_at(*regions, {0.4, 0.3, 0.3});
    ASSERT_EQ(beyond.intervals.size(), 1U);
    EXPECT_TRUE(beyond.intervals[0].to_center);
    // The gap ends first, then what was around it: the outer pair takes ends of two intervals.
    Octant nest({slab(1, 2), slab(3, 4)}, {}, {});
    for (const unsigned j : {1U, 2U}) {
        nest.record(0, j, true, 1, 64, 2.4, 2.6);
        nest.record(0, j, true, 0, 128, 2, 3);
    }
    regions = nest.divided();
    ASSERT_TRUE(regions.has_value());
    ASSERT_EQ(regions->size(), 3U);
    EXPECT_EQ(region_at(*regions, {0.8, 0.1, 0.1}).intervals.size(), 2U);
    const FoldRegion& merged = region_at(*regions, {0.6, 0.2, 0.2});
    ASSERT_EQ(merged.intervals.size(), 1U);
    EXPECT_EQ(merged.intervals[0].layer, 0U);
    EXPECT_EQ(merged.intervals[0].inner_layer, 1U);
    EXPECT_TRUE(region_at(*regions, {0.4, 0.3, 0.3}).intervals.empty());
    // The other way round the records take a pair of one kind, and none that matches.
    Octant wrong({slab(1, 2), slab(3, 4)}, {}, {});
    for (const unsigned j : {1U, 2U}) {
        wrong.record(0, j, true, 0, 128, 2, 3);
        wrong.record(0, j, true, 1, 64, 2.4, 2.6);
    }
    EXPECT_FALSE(wrong.divided().has_value());
}

TEST(JudgeFolds, OpenWalls) {
    for (const bool inside : {false, true}) {
        for (const bool pair : {false, true}) {
            // Where a shell in front of the border ends in a pair, the wall of what is behind is open too.
            const Intervals bowl = pair ? Intervals{slab(1, 1.5), slab(2, 0)} : Intervals{slab(2, 0)};
            Octant octant(bowl, {}, {}, inside);
            for (const unsigned j : {1U, 2U}) {
                if (pair) octant.record(0, j, true, 0, 64, 1.1, 1.2);
                octant.record(0, j, false, 0, 128, 2.4);
            }
            const auto regions = octant.divided();
            ASSERT_TRUE(regions.has_value());
            ASSERT_EQ(regions->size(), pair ? 3U : 2U);
            const FoldRegion& region = region_at(*regions, {0.6, 0.2, 0.2});
            const auto& open = region.intervals.back().open;
            ASSERT_EQ(open.has_value(), inside);
            if (!inside) continue;
            EXPECT_NEAR(dot(region.sides[*open], Vec3d{0.5, 0.5, 0}), 0, 1e-9);
            EXPECT_FALSE(region_at(*regions, {0.8, 0.1, 0.1}).intervals.front().open.has_value() && pair);
        }
    }
    Octant paired({slab(2, 0)}, {slab(1, 1.5), slab(2, 0)}, {slab(2, 0)}, true);
    for (const unsigned j : {0U, 2U}) paired.record(1, j, true, 0, 128, 1.1, 1.2);
    auto regions = paired.divided();
    ASSERT_TRUE(regions.has_value());
    for (const FoldRegion& region : *regions)
        for (const auto& interval : region.intervals) EXPECT_FALSE(interval.open.has_value());
    Octant along({slab(1, 0)}, {}, {}, true);
    for (const unsigned j : {1U, 2U}) along.record(0, j, false, 0, 256, 1.2);
    regions = along.divided();
    ASSERT_TRUE(regions.has_value());
    EXPECT_FALSE(regions->front().intervals[0].open.has_value()) << "at an edge";
}

TEST(JudgeFolds, RecordsThatMakeNoSense) {
    const Intervals shell{slab(1, 2), slab(4, 0)};
    const Intervals ball{slab(4, 0)};
    const auto fails = [&](const std::function<void(Octant&)>& change) {
        Octant octant(shell, ball, ball);
        octant.record(0, 1, true, 0, 128, 1.5, 1.6);
        octant.record(0, 2, true, 0, 128, 1.5, 1.6);
        change(octant);
        return !octant.divided().has_value();
    };
    EXPECT_FALSE(fails([](Octant&) {}));
    EXPECT_TRUE(fails([](Octant& o) { o.records[0][0].index = 2; })) << "one of two is beyond the last";
    EXPECT_TRUE(fails([](Octant& o) { o.records[0][0].index = 63; }));
    EXPECT_TRUE(fails([](Octant& o) { o.records[0][0].end = 1; }));
    EXPECT_TRUE(fails([](Octant& o) { o.records[0][0].index = 1; })) << "an outer end is left, and matches; "
                                                                        "but its sheet is cut towards z";
    EXPECT_TRUE(fails([](Octant& o) { o.records[0][0].pair = false; })) << "three are left";
    EXPECT_TRUE(fails([](Octant& o) { o.records[0].clear(); })) << "three are left";
    EXPECT_TRUE(fails([](Octant& o) { o.records[0][0].cut[0] = 0; }));
    EXPECT_TRUE(fails([](Octant& o) { o.records[0][0].cut[1] = 0; }));
    EXPECT_TRUE(fails([](Octant& o) { o.record(0, 1, true, 0, 10, 1, 1); })) << "there is one left";
    // Two neighbours of one kind: only after another is gone.
    Octant twins({slab(1, 2), slab(3, 0)}, {}, {});
    for (const unsigned j : {1U, 2U}) {
        twins.record(0, j, false, 1, 128, 2);
        twins.record(0, j, true, 0, 128, 1, 3);
    }
    EXPECT_FALSE(twins.divided().has_value());
}

// n shells at one corner, each with a line of its own.
TEST(JudgeFolds, FiveLinesAtMost) {
    for (const unsigned n : {5U, 6U}) {
        Intervals shells;
        for (unsigned k = 0; k < n; ++k) shells.push_back(slab(1 + k, 1.5 + k));
        Octant octant(shells, {}, {});
        for (unsigned k = 0; k < n; ++k)
            for (const unsigned j : {1U, 2U}) octant.record(0, j, true, 0, 20 * (k + 1), 1.2 + k, 1.3 + k);
        const auto regions = octant.divided();
        EXPECT_EQ(regions.has_value(), n == 5);
        EXPECT_EQ(regions.has_value() ? regions->size() : 6U, 6U);
    }
}

TEST(JudgeFolds, PlanesStayAboveAQuarterOfTheirLeast) {
    // 10 at x, 1 at y, and w half way to z: at y's cut that is w - 2.25.
    for (const bool stays : {false, true}) {
        const double w = stays ? 2.6 : 2.4;
        Octant octant({slab(10, 0)}, {slab(1, 0)}, {});
        octant.record(0, 2, false, 0, 128, w);
        octant.record(1, 2, false, 0, 128, w);
        EXPECT_EQ(octant.divided().has_value(), stays);
    }
}

// A shell at +x of the smallest grid, that ends half way to all others, in front of a ball: four
// corners cut off, which make a pyramid.
TEST(JudgeFolds, ShellOfOneSample) {
    OwnedPart owned = make_part({.cells = 2, .layers = 2}, [](Vec3d g) {
        std::vector<MadeInterval> found;
        if (g.x > 0.5) found.push_back({0.9, 0.6, g, -g});
        found.push_back({0.2 * length(g), 0, g, {}});
        return found;
    });
    const Grid grid{Mapping::octahedral, 3, 3};
    std::vector<FoldRecord> records;
    const Vec3d middle{0.5, 0.5, 0};
    for (std::uint32_t edge = 0; edge < edge_count(2); ++edge) {
        if (!is_edge(2, edge)) continue;
        const std::array<TexelIndex, 2> ends = edge_ends(2, edge);
        const bool here[2] = {sample_direction(grid, ends[0]).x > 0.5,
                              sample_direction(grid, ends[1]).x > 0.5};
        if (here[0] == here[1]) continue;
        records.push_back({edge,
                           true,
                           std::uint8_t(here[0] ? 0 : 1),
                           0,
                           127,
                           {code_of(middle, 1 / 0.75), code_of(middle, 1 / 0.74)}});
    }
    ASSERT_EQ(records.size(), 5U) << "the edge to -z twice";
    set_folds(owned, records);
    const Judge judge(owned.part);
    EXPECT_EQ(judge.folded_triangles(), 4U);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (int i = 0; i < 5000; ++i) {
        const Vec3d g{1, uniform(random), uniform(random)};
        const double l = 1 + std::abs(g.y) + std::abs(g.z);
        const double x = 1 / l;
        if (std::abs(x - 0.5) < 1e-3) continue;
        const auto events = judge.events({g * 3.0, g * -1.0, 0, 2.9});
        ASSERT_EQ(events.size(), x > 0.5 ? 4U : 2U) << "the last where the ray ends";
        // W = 1/0.9 at x, and w of the cut's code at x = 1/2.
        const double outer = 1 / 0.9 + (w_of(middle, records[0].cut[0]) - 1 / 0.9) * (1 - x) / 0.5;
        const double inner = 1 / 0.6 + (w_of(middle, records[0].cut[1]) - 1 / 0.6) * (1 - x) / 0.5;
        if (x < 0.5) continue;
        EXPECT_NEAR(3 - events[0].t, 1 / (outer * l), 1e-6);
        EXPECT_NEAR(3 - events[1].t, 1 / (inner * l), 1e-6);
    }
    // Across the line: into the step between the two ends where the shell stops.
    const Vec3d g = Vec3d{0.5, 0.3, 0.2} * 0.745;
    EXPECT_TRUE(judge.near_boundary(g, 1e-3));
    EXPECT_FALSE(judge.solid(g - Vec3d{0.01, 0, 0}));
}

} // namespace
