// SPDX-License-Identifier: Apache-2.0
// Which centre and frame are taken, of shapes where it is known what is best.
#include "../support/shapes.h"

#include "../../libspa/bake/bake.h"
#include "../../libspa/bake/coarse_model.h"
#include "../../libspa/bake/placement.h"
#include "../../libspa/bake/surface_views.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace spa::bake {
namespace {

Options automatic(std::uint32_t layers = 2) {
    Options options;
    options.center = Center::automatic;
    options.frame = Frame::automatic;
    options.layers = layers;
    return options;
}

Model ball() {
    Model model = test::empty_model();
    test::add_sphere(model, {1, 2, 3}, 2, 30);
    return model;
}

// The middle of the box of half a ring lies outside the ring.
Model half_ring() {
    Model model = test::empty_model();
    test::add_torus(model, 2, 0.4F, 48);
    model.triangles.resize(model.triangles.size() / 2);
    model.triangle_materials.resize(model.triangles.size());
    return model;
}

// From its box's middle the three plates of a corner are seen from one side, two of them nearly edge-on.
Model l_shape() {
    Model model = test::empty_model();
    test::add_box(model, {0, 0, 0}, {4, 1, 1});
    test::add_box(model, {0, 0, 0}, {1, 4, 1});
    return model;
}

TEST(Placement, PlainIsAsAsked) {
    Options options;
    const Placement placement = place_part(half_ring(), options, {});
    EXPECT_EQ(placement.center_chosen, Center::bounds);
    EXPECT_EQ(placement.frame_chosen, Frame::sphere);
    EXPECT_FALSE(placement.captured_bounds);
    EXPECT_FALSE(placement.captured);
    EXPECT_FALSE(placement.elongation);
}

TEST(Placement, OfABallIsPlain) {
    const Placement placement = place_part(ball(), automatic(), {});
    EXPECT_EQ(placement.center_chosen, Center::bounds);
    EXPECT_EQ(placement.frame_chosen, Frame::sphere);
    EXPECT_NEAR(placement.captured.value(), 1, 1e-6);
    EXPECT_NEAR(placement.elongation.value(), 1, 0.02);
    EXPECT_LT(length(placement.center - Vec3d{1, 2, 3}), 0.02);
}

TEST(Placement, OfALongBoxIsAffine) {
    Model model = test::empty_model();
    test::add_box(model, {-8, -1, -1}, {8, 1, 1});
    const Placement placement = place_part(model, automatic(), {});
    EXPECT_EQ(placement.center_chosen, Center::bounds);
    EXPECT_EQ(placement.frame_chosen, Frame::affine);
    EXPECT_NEAR(placement.elongation.value(), 8, 1e-6);
}

TEST(Placement, AnLHasAKernelThatItsBoxMisses) {
    Options options;
    options.center = Center::captured;
    const Placement placement = place_part(l_shape(), options, {});
    EXPECT_EQ(placement.center_chosen, Center::captured);
    EXPECT_TRUE(placement.kernel);
    // The cube at the corner of the L, which sees all of both arms.
    for (const double p : {placement.center.x, placement.center.y, placement.center.z}) {
        EXPECT_GT(p, 0.2);
        EXPECT_LT(p, 0.8);
    }
    EXPECT_EQ(place_part(l_shape(), automatic(1), {}).center_chosen, Center::captured);
}

TEST(Placement, TheCapturedCentreSeesMoreOfHalfARing) {
    Options options;
    options.layers = 1;
    options.center = Center::captured;
    const Placement placement = place_part(half_ring(), options, {});
    EXPECT_FALSE(placement.kernel);
    EXPECT_GT(placement.captured.value(), placement.captured_bounds.value() * 1.05);
}

TEST(Placement, DoesNotDependOnThreads) {
    Model model = test::empty_model();
    test::add_torus(model, 2, 0.6F, 100);
    test::add_sphere(model, {2, 1, 0}, 0.7F, 40);
    ASSERT_GT(model.triangles.size(), 16384U);
    const Placement one = place_part(model, automatic(), {});
    for (const int threads : {1, 3}) {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            const Placement again = place_part(model, automatic(), {});
            EXPECT_EQ(again.center, one.center);
            EXPECT_EQ(again.captured, one.captured);
            EXPECT_EQ(again.frame_chosen, one.frame_chosen);
        });
    }
}

// Another order of the triangles changes sums in their last bits, and so a search by steps not at all.
TEST(Placement, DoesNotDependOnTheOrderOfTriangles) {
    for (Model model : {half_ring(), l_shape(), ball()}) {
        const Placement before = place_part(model, automatic(), {});
        std::mt19937 random(5);
        std::shuffle(model.triangles.begin(), model.triangles.end(), random);
        const Placement after = place_part(model, automatic(), {});
        EXPECT_EQ(after.center_chosen, before.center_chosen);
        EXPECT_EQ(after.frame_chosen, before.frame_chosen);
        EXPECT_EQ(after.kernel, before.kernel);
        EXPECT_LT(length(after.center - before.center), 1e-6);
        EXPECT_NEAR(after.captured.value(), before.captured.value(), 1e-6);
    }
}

// A wall and a point of it: on it everything is edge-on, whatever the margin.
TEST(Placement, OfAWallIsBesideIt) {
    Model model = test::empty_model();
    test::add_quad(model, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    const Result result = bake_model(model, [] {
        Options options = automatic();
        options.grid = options.color_grid = {Mapping::octahedral, 33, 33};
        return options;
    }());
    EXPECT_GT(std::abs(result.map.map.parts[0].center.z), 0.1);
    EXPECT_EQ(result.report.center_moved, 0);
}

TEST(SurfaceViews, ABallFromItsMiddle) {
    const Model model = ball();
    const SurfaceViews views(model, 1);
    const View middle = views.from({{1, 2, 3}, {}});
    EXPECT_NEAR(middle.captured, 1, 1e-9);
    EXPECT_NEAR(middle.spacing, 1 / std::sqrt(3.0), 0.01);
    EXPECT_GT(views.from({{2, 2, 3}, {}}).spacing, middle.spacing * 1.05);
    // Seen from outside, the far half is behind the near one: outermost is the far one.
    const View outside = views.from({{9, 2, 3}, {}});
    EXPECT_GT(outside.captured, 0.4);
    EXPECT_LT(outside.captured, 0.7);
    EXPECT_NEAR(SurfaceViews(model, 2).from({{9, 2, 3}, {}}).captured, 1, 1e-9);
}

// A box that its frame makes a cube is sampled as a cube is, but for the size of its parts.
TEST(SurfaceViews, TheFrameOfABoxEvensItOut) {
    Model model = test::empty_model();
    test::add_box(model, {-4, -1, -1}, {4, 1, 1});
    const SurfaceViews views(model, 2);
    const View plain = views.from({{}, {}});
    const View stretched = views.from({{}, {{{4, 0, 0}, {0, 1, 0}, {0, 0, 1}}}});
    EXPECT_LT(stretched.spacing, 0.8 * plain.spacing);
    const View scaled = views.from({{}, {{{3, 0, 0}, {0, 3, 0}, {0, 0, 3}}}});
    EXPECT_NEAR(scaled.spacing, plain.spacing, 1e-9);
}

TEST(CoarseModel, KeepsSmallModelsAndReducesLargeOnes) {
    EXPECT_EQ(coarse_model(l_shape()).triangles.size(), 24U);
    Model model = test::empty_model();
    test::add_sphere(model, {5, 0, 0}, 1, 200);
    model.positions.push_back({1000, 0, 0}); // that no triangle uses
    model.normals.push_back({0, 0, 1});
    ASSERT_GT(model.triangles.size(), 40000U);
    const Model coarse = coarse_model(model);
    EXPECT_LT(coarse.triangles.size(), model.triangles.size() / 3);
    double area = 0;
    for (const Triangle& t : coarse.triangles) {
        const auto corner = [&](unsigned k) { return to_double(coarse.positions[t.vertex[k]]); };
        area += length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
        for (unsigned k = 0; k < 3; ++k) EXPECT_NEAR(length(corner(k) - Vec3d{5, 0, 0}), 1, 0.02);
    }
    EXPECT_NEAR(area, 4 * std::numbers::pi, 0.2);
}

} // namespace
} // namespace spa::bake
