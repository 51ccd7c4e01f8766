// SPDX-License-Identifier: Apache-2.0
// What the baker finds between samples: on shapes whose silhouettes are known, and against the radial baker
// on a finer grid.
#include "../../libspa/bake/cast_points.h"
#include "../../libspa/bake/center.h"
#include "../../libspa/bake/edge_paths.h"
#include "../../libspa/bake/find_folds.h"
#include "../../libspa/bake/fold_records.h"
#include "../../libspa/bake/mixed.h"
#include "../../libspa/bake/radial.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace spa::bake {
namespace {

Model two_spheres() {
    Model model = test::empty_model();
    test::add_sphere(model, {0, 0, 0}, 0.5F, 64);
    test::add_sphere(model, {0.4F, 0.3F, 3}, 1, 96);
    return model;
}

TEST(PointCaster, FindsWhatTheRadialBakerFindsOnAFinerGrid) {
    const Model model = two_spheres();
    const CenteredModel centered = center_model(model, make_part_frame(model, {0.05, 0.02, 0.4}, false));
    constexpr std::uint32_t cells = 8, steps = 16;
    const PointCaster caster(centered, cells, steps);
    const CrossingGrid expected = cast_radial(centered, caster.grid(), {.outermost_only = false});
    std::vector<TexelIndex> points; // every sample of the fine grid, the borders among them
    for (std::uint32_t y = 0; y < caster.grid().height; ++y)
        for (std::uint32_t x = 0; x < caster.grid().width; ++x) points.push_back({x, y});
    const PointCrossings found = caster.cast(points);
    ASSERT_EQ(found.first, expected.first);
    for (std::size_t i = 0; i < found.crossings.size(); ++i) {
        ASSERT_EQ(found.crossings[i].radius, expected.crossings[i].radius);
        ASSERT_EQ(found.crossings[i].triangle, expected.crossings[i].triangle);
        ASSERT_EQ(found.crossings[i].front_facing, expected.crossings[i].front_facing);
    }
}

// Points along an edge in the plane y = 0 of the octant, with crossings at these W, outer and inner in turns.
std::vector<EdgePoint> edge_points(const std::vector<std::vector<double>>& w) {
    std::vector<EdgePoint> points;
    for (std::size_t p = 0; p < w.size(); ++p) {
        EdgePoint point;
        point.position = double(p) / double(w.size() - 1);
        point.direction = {0.5 + 0.01 * point.position, 0, 0.5 - 0.01 * point.position};
        for (std::size_t i = 0; i < w[p].size(); ++i) {
            EdgeCrossing crossing;
            crossing.end.w = w[p][i];
            crossing.end.plane = Vec3d{1, 1, 1} * w[p][i]; // W stays what it is
            crossing.end.bounded = true;
            crossing.inner = i % 2 == 1;
            point.crossings.push_back(crossing);
        }
        points.push_back(point);
    }
    return points;
}

constexpr double edge_length = 0.02;

TEST(EdgePaths, APairThatMeetsComesBack) {
    // An interval of solid that is gone from the fourth point on, in front of one that goes on.
    const auto points = edge_points({{1, 1.2, 3, 4}, {1, 1.1, 3, 4}, {1, 1.01, 3, 4}, {3, 4}, {3, 4}});
    const EdgePaths paths(points, edge_length);
    const std::vector<EdgePath>& first = paths.from(0);
    ASSERT_EQ(first.size(), 4U);
    for (const std::uint32_t i : {0U, 1U}) {
        EXPECT_EQ(first[i].to, EdgePath::To::same_end);
        EXPECT_EQ(first[i].index, 1 - i);
        EXPECT_DOUBLE_EQ(first[i].position, 0.625); // between the third point and the fourth
        EXPECT_DOUBLE_EQ(first[i].w, 1.005);
    }
    for (const std::uint32_t i : {2U, 3U}) {
        EXPECT_EQ(first[i].to, EdgePath::To::other_end);
        EXPECT_EQ(first[i].index, i - 2);
        EXPECT_EQ(paths.from(1)[i - 2].index, i);
    }
}

// Two thirds of the way from where they meet to the tangent plane, which here keeps W.
TEST(EdgePaths, CutsAreBetweenTheFoldAndTheTangentPlane) {
    const auto points = edge_points({{1, 1.2}, {1, 1.1}, {1, 1.01}, {}, {}});
    const EdgeFolds folds = fold_records(7, points, EdgePaths(points, edge_length), {2, 0});
    ASSERT_EQ(folds.records.size(), 1U);
    const FoldRecord& record = folds.records[0];
    EXPECT_TRUE(record.pair);
    EXPECT_DOUBLE_EQ(fold_position(record.place), 0.625);
    const Vec3d g = points[0].direction * 0.375 + points[4].direction * 0.625;
    EXPECT_NEAR(length(g) * 65535 / record.cut[0], 1.005 - 2.0 / 3 * 0.005, 1e-4);
    EXPECT_NEAR(length(g) * 65535 / record.cut[1], 1.005 + 2.0 / 3 * 0.195, 1e-4);
}

TEST(EdgePaths, ASurfaceThatFoldsTwiceGoesOn) {
    // What is the first crossing at one end is the last at the other: in between it turns twice.
    const auto points =
        edge_points({{1}, {1, 1.3, 1.302}, {1, 1.2, 1.3}, {1, 1.1, 1.3}, {1, 1.002, 1.3}, {1.3}, {1.3}});
    const EdgePaths paths(points, edge_length);
    ASSERT_EQ(paths.from(0).size(), 1U);
    EXPECT_EQ(paths.from(0)[0].to, EdgePath::To::other_end);
    EXPECT_EQ(paths.from(1)[0].to, EdgePath::To::other_end);
    const EdgeFolds folds = fold_records(7, points, paths, {1, 1});
    EXPECT_TRUE(folds.records.empty());
    EXPECT_FALSE(folds.unresolved);
}

TEST(EdgePaths, WhatIsNotStoredAtTheOtherEndIsToldToEndThere) {
    const auto points = edge_points({{1, 1.2}, {1, 1.2}, {0.5, 0.6, 1, 1.2}, {0.5, 0.6, 1, 1.2}});
    const EdgePaths paths(points, edge_length);
    // One interval is stored: at the far end it is another one.
    const EdgeFolds folds = fold_records(7, points, paths, {2, 2});
    ASSERT_EQ(folds.records.size(), 3U);
    for (const std::size_t i : {0U, 1U}) {
        EXPECT_FALSE(folds.records[i].pair);
        EXPECT_EQ(folds.records[i].end, 0);
        EXPECT_EQ(folds.records[i].index, 0); // each in its turn is the first of those that are left
        EXPECT_EQ(folds.records[i].place, 255);
    }
    EXPECT_TRUE(folds.records[2].pair);
    EXPECT_EQ(folds.records[2].end, 1);
    EXPECT_DOUBLE_EQ(fold_position(folds.records[2].place), 0.5);
}

struct Found {
    SurfaceGrid surfaces;
    std::vector<std::uint8_t> before, after; // edges that match
    Folds folds;
    double scale = 1;
};

Found find(const Model& model, std::uint32_t cells, std::uint32_t layers, Vec3d center = {}) {
    const Grid grid{Mapping::octahedral, cells + 1, cells + 1};
    const PartFrame part = make_part_frame(model, center, false);
    const CenteredModel centered = center_model(model, part);
    const CrossingGrid crossings = cast_radial(centered, grid, {.outermost_only = false});
    const Components components = find_components(model);
    const Orientation orientation = orient_components(crossings, components);
    IntervalStatistics statistics;
    Found found;
    found.scale = part.radius;
    found.surfaces = pair_intervals(crossings, components, orientation, layers, statistics);
    found.before = found.after = match_edges(found.surfaces, face_normals(centered));
    found.folds = find_folds(centered, components, orientation, found.surfaces, found.after);
    return found;
}

// Seen from the origin, a sphere's silhouette is a circle of directions.
TEST(FindFolds, SilhouettesLieWhereTheyAre) {
    constexpr std::uint32_t cells = 64;
    const Found found = find(two_spheres(), cells, 2);
    const Vec3d center{0.4, 0.3, 3};
    const double silhouette = std::asin(1 / length(center));
    ASSERT_GT(found.folds.records.size(), 60U);
    EXPECT_EQ(found.folds.statistics.singles, 0U);
    EXPECT_EQ(found.folds.statistics.unresolved, 0U);
    const Grid grid{Mapping::octahedral, cells + 1, cells + 1};
    for (const FoldRecord& record : found.folds.records) {
        ASSERT_TRUE(record.pair);
        const auto ends = edge_ends(cells, record.edge);
        const double f = fold_position(record.place);
        const Vec3d g = sample_direction(grid, ends[record.end]) * (1 - f) +
                        sample_direction(grid, ends[1U - record.end]) * f;
        const double angle = std::acos(dot(normalize(g), normalize(center)));
        // Half a sixteenth of an edge, and what the sphere of triangles is smaller.
        ASSERT_NEAR(angle, silhouette, 2.9 / cells / 16 + 1e-3);
        // Within the sphere's shell there, seen along the tangent.
        const double tangent = std::sqrt(dot(center, center) - 1) / found.scale;
        ASSERT_NEAR(record.cut[0] / 65535.0, tangent, 0.12);
        ASSERT_GE(record.cut[0], record.cut[1]);
    }
}

std::size_t stored_at(const SurfaceGrid& surfaces, TexelIndex at) {
    std::size_t count = 0;
    const std::size_t sample = std::size_t(at.y) * surfaces.grid.width + at.x;
    while (count < surfaces.surfaces.size() && surfaces.surfaces[count][sample].radius > 0) ++count;
    return count;
}

// Whatever the layers cut off: after its records every edge matches in order.
TEST(FindFolds, RecordsLeaveWhatMatches) {
    Model model = test::empty_model();
    test::add_sphere(model, {0, 0, 0}, 0.2F, 24);
    for (int i = 0; i < 12; ++i)
        test::add_sphere(model, {std::cos(float(i)), std::sin(float(i) * 1.7F), std::sin(float(i))}, 0.3F,
                         24);
    for (const std::uint32_t layers : {1U, 2U, 4U}) {
        constexpr std::uint32_t cells = 24;
        const Found found = find(model, cells, layers);
        ASSERT_GT(found.folds.records.size(), 50U);
        EXPECT_TRUE(std::is_sorted(found.folds.records.begin(), found.folds.records.end(),
                                   [](const FoldRecord& a, const FoldRecord& b) { return a.edge < b.edge; }));
        std::size_t next = 0;
        for (std::uint32_t edge = 0; edge < edge_count(cells); ++edge) {
            if (!is_edge(cells, edge)) continue;
            const auto ends = edge_ends(cells, edge);
            std::array<std::vector<std::size_t>, 2> left;
            for (const std::size_t end : {0U, 1U})
                for (std::size_t k = 0; k < stored_at(found.surfaces, ends[end]); ++k) left[end].push_back(k);
            const std::size_t first = next;
            for (; next < found.folds.records.size() && found.folds.records[next].edge == edge; ++next) {
                const FoldRecord& record = found.folds.records[next];
                std::vector<std::size_t>& here = left[record.end];
                const std::size_t count = record.pair ? 2 : 1;
                ASSERT_LE(record.index + count, here.size());
                if (record.pair) {
                    ASSERT_NE(here[record.index] % 2, here[record.index + 1U] % 2);
                }
                here.erase(here.begin() + record.index, here.begin() + record.index + std::ptrdiff_t(count));
            }
            ASSERT_EQ(left[0].size(), left[1].size()) << edge;
            for (std::size_t k = 0; k < left[0].size(); ++k) ASSERT_EQ(left[0][k] % 2, left[1][k] % 2);
            ASSERT_EQ(found.after[edge] != 0, next == first) << edge;
            if (found.before[edge] != 0) {
                ASSERT_EQ(next, first);
            }
        }
        EXPECT_EQ(next, found.folds.records.size());
    }
}

// Both edges of the border that are the same edge of the object say the same.
TEST(FindFolds, TheBorderAgreesWithItself) {
    Model model = test::empty_model();
    test::add_sphere(model, {0, 0, 0}, 0.4F, 24);
    // The upper border is the quarter of a plane between -Z and +Y, from both sides: it cuts all of these.
    for (int i = 0; i < 4; ++i)
        test::add_sphere(model, {0.1F, 0.6F * float(i), 1.5F * float(i) - 5.5F}, 0.6F, 32);
    constexpr std::uint32_t cells = 32;
    const Found found = find(model, cells, 2);
    std::size_t checked = 0;
    for (const FoldRecord& record : found.folds.records) {
        const auto ends = edge_ends(cells, record.edge);
        if (record.edge % 3 != 0 || ends[0].y != 0) continue;
        FoldRecord same = record;
        same.edge = edge_number(cells, {cells - ends[1].x, 0}, 0);
        same.end = std::uint8_t(1 - record.end);
        EXPECT_EQ(std::count(found.folds.records.begin(), found.folds.records.end(), same), 1);
        ++checked;
    }
    EXPECT_GE(checked, 4U);
}

// Which way a face is wound tells nothing where its neighbours contradict it.
TEST(TurnedFaces, MakeNoDifference) {
    const Model model = two_spheres();
    const Found straight = find(model, 32, 2);
    for (const unsigned percent : {3U, 50U, 97U}) {
        Model turned = model;
        std::mt19937 random(percent);
        for (Triangle& triangle : turned.triangles)
            if (random() % 100 < percent) std::swap(triangle.vertex[0], triangle.vertex[1]);
        const Found found = find(turned, 32, 2);
        for (std::size_t k = 0; k < straight.surfaces.surfaces.size(); ++k)
            for (std::size_t s = 0; s < straight.surfaces.surfaces[k].size(); ++s)
                ASSERT_EQ(found.surfaces.surfaces[k][s].radius, straight.surfaces.surfaces[k][s].radius);
        EXPECT_EQ(found.folds.records, straight.folds.records);
    }
}

} // namespace
} // namespace spa::bake
