// SPDX-License-Identifier: Apache-2.0
// Embree's rays, the third caster, against the radial baker and against formulas.
#include "../../libspa/bake/center.h"
#include "../../libspa/bake/radial.h"
#include "../../libspa/measure/cast_embree.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spa::bake {
namespace {

CenteredModel around(const Model& model, Vec3d center) {
    return center_model(model, make_part_frame(model, center, false));
}

CrossingGrid embree(const CenteredModel& model, const Grid& grid, const CastOptions& options) {
    const trace::TriangleScene scene(model.positions, model.model->triangles);
    return measure::cast_embree(model, scene, grid, options);
}

bool same_sample(const CrossingGrid& a, const CrossingGrid& b, std::size_t s) {
    return std::equal(a.crossings.begin() + std::ptrdiff_t(a.first[s]),
                      a.crossings.begin() + std::ptrdiff_t(a.first[s + 1]),
                      b.crossings.begin() + std::ptrdiff_t(b.first[s]),
                      b.crossings.begin() + std::ptrdiff_t(b.first[s + 1]),
                      [](const Crossing& p, const Crossing& q) {
                          return p.triangle == q.triangle && p.radius == q.radius && p.normal == q.normal &&
                                 p.color == q.color && p.front_facing == q.front_facing;
                      });
}

std::size_t differing(const CrossingGrid& a, const CrossingGrid& b) {
    EXPECT_EQ(a.first.size(), b.first.size());
    std::size_t count = 0;
    for (std::size_t s = 0; s + 1 < a.first.size(); ++s) count += same_sample(a, b, s) ? 0 : 1;
    return count;
}

struct Shape {
    const char* name;
    Model model;
    Vec3d center;
};

std::vector<Shape> shapes() {
    std::vector<Shape> result;
    result.push_back({"sphere", test::empty_model(), {0.3, -0.2, 0.1}});
    test::add_sphere(result.back().model, {}, 1, 48);
    result.push_back({"torus", test::empty_model(), {0.9, 0.01, 0.02}});
    test::add_torus(result.back().model, 1, 0.4F, 64);
    result.push_back({"soup", test::random_soup(500, 7), {}});
    test::add_random_texture(result.back().model, 32, 7);
    result.back().model.materials.front().alpha_mode = AlphaMode::mask;
    return result;
}

TEST(Embree, FindsWhatTheRadialBakerFinds) {
    for (const Shape& shape : shapes()) {
        const CenteredModel model = around(shape.model, shape.center);
        for (const Grid& grid : {Grid{Mapping::octahedral, 65, 65}, Grid{Mapping::latlong, 80, 60}}) {
            for (const bool outermost : {true, false}) {
                const CastOptions options{.outermost_only = outermost};
                const CrossingGrid expected = cast_radial(model, grid, options);
                const CrossingGrid found = embree(model, grid, options);
                // A ray may pass within float rounding of an edge.
                EXPECT_LE(differing(expected, found), 2U) << shape.name << name(grid.mapping) << outermost;
                EXPECT_GT(found.crossings.size(), std::size_t(grid.width) * grid.height / 2);
            }
        }
    }
}

// Both radii of a ray that meets a sphere: |r u - c| = R.
TEST(Embree, MeetsASphereWhereTheFormulaSays) {
    Model model = test::empty_model();
    const Vec3d center{0.1, 0.9, -1.2}; // outside: two crossings or none
    test::add_sphere(model, to_float(center), 1, 200);
    const CenteredModel scene = around(model, {});
    const double scale = 1 / (1 + length(center));
    const Grid grid{Mapping::octahedral, 65, 65};
    const CrossingGrid found = embree(scene, grid, {.outermost_only = false});
    std::size_t met = 0;
    for (std::size_t s = 0; s + 1 < found.first.size(); ++s) {
        const Vec3d u =
            normalize(sample_direction(grid, {std::uint32_t(s % grid.width), std::uint32_t(s / grid.width)}));
        const double middle = dot(u, center);
        const double root2 = 1 - dot(center, center) + middle * middle;
        if (std::abs(root2) < 0.02) continue; // grazing
        ASSERT_EQ(found.first[s + 1] - found.first[s], root2 > 0 && middle > 0 ? 2U : 0U) << s;
        if (root2 < 0 || middle < 0) continue;
        ++met;
        const Crossing* const c = found.crossings.data() + found.first[s];
        EXPECT_NEAR(double(c[0].radius), (middle + std::sqrt(root2)) * scale, 1e-3);
        EXPECT_NEAR(double(c[1].radius), (middle - std::sqrt(root2)) * scale, 1e-3);
        EXPECT_TRUE(c[0].front_facing);
        EXPECT_FALSE(c[1].front_facing);
    }
    EXPECT_GT(met, 200U);
}

TEST(Embree, GivesTheSameForAnyNumberOfThreads) {
    const Model soup = test::random_soup(300, 3);
    const CenteredModel model = around(soup, {});
    const Grid grid{Mapping::octahedral, 33, 33};
    EXPECT_EQ(differing(embree(model, grid, {.outermost_only = false, .threads = 1}),
                        embree(model, grid, {.outermost_only = false, .threads = 2})),
              0U);
}

TEST(Embree, CanBeCancelled) {
    const Model soup = test::random_soup(10, 3);
    const CenteredModel model = around(soup, {});
    CastOptions options;
    options.progress = [](double) { return false; };
    EXPECT_THROW(embree(model, {Mapping::octahedral, 33, 33}, options), Cancelled);
}

} // namespace
} // namespace spa::bake
