// SPDX-License-Identifier: Apache-2.0
// The measures against shapes whose figures follow from geometry, and against brute force.
#include "../../libspa/bake/center.h"
#include "../../libspa/core/error.h"
#include "../../libspa/measure/map_surface.h"
#include "../../libspa/measure/measure_map.h"
#include "../../libspa/measure/surface_samples.h"
#include "../../libspa/mesh/closest_point.h"
#include "../support/shapes.h"
#include "defects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spa::measure {
namespace {

Measurement measure_model(const Model& model, const bake::Options& options) {
    const bake::Result baked = bake::bake_model(model, options);
    return measure_map(model, baked.map.map.parts.front(), {20'000, options.samples, options.layers});
}

TEST(MeasureMap, OfASphereIsQuantizationAlone) {
    Model model = test::empty_model();
    test::add_sphere(model, {1, 2, 3}, 2, 128);
    bake::Options options = test::small_options();
    const Measurement m = measure_model(model, options);
    EXPECT_NEAR(m.source_radius, 2, 1e-5);
    EXPECT_EQ(m.captured_area, 1);
    EXPECT_EQ(m.star_error.count, 0U);
    EXPECT_EQ(m.coverage.share(), 1);
    EXPECT_TRUE(m.quantization.holds());
    EXPECT_DOUBLE_EQ(m.quantization.bound, 0.5 / 65535);
    // Uniformly distributed rounding: mean a quarter of a code, rms 1/sqrt(12) of one.
    EXPECT_NEAR(m.quantization.error.mean * 65535, 0.25, 0.01);
    EXPECT_NEAR(m.quantization.error.rms * 65535, 1 / std::sqrt(12.0), 0.01);
    EXPECT_LE(m.texel_distance.max, m.quantization.bound + 2e-7);
    // Cells of side h = 2/64 are widest at the middle of an octahedron's face:
    // equilateral triangles with edges of h sqrt(6), whose centres lie h^2 below the sphere. The mesh has
    // facets of its own.
    EXPECT_NEAR(m.surface_distance.max, std::pow(2.0 / 64, 2), 0.1 * std::pow(2.0 / 64, 2));
}

TEST(MeasureMap, TheQuantizationBoundFollowsTheFormat) {
    Model model = test::empty_model();
    test::add_sphere(model, {0, 0, 0}, 1, 128);
    bake::Options options = test::small_options();
    options.depth = ElementFormat::u8;
    const Measurement coarse = measure_model(model, options);
    EXPECT_TRUE(coarse.quantization.holds());
    EXPECT_DOUBLE_EQ(coarse.quantization.bound, 0.5 / 255);
    EXPECT_GT(coarse.texel_distance.max, 1e-4);
    options.depth = ElementFormat::f32;
    const Measurement fine = measure_model(model, options);
    EXPECT_TRUE(fine.quantization.holds());
    EXPECT_LT(fine.texel_distance.max, 2e-7);
}

// Faces of a cube are planes, which the octahedral map's triangles hold exactly, unless an edge goes through
// them.
TEST(MeasureMap, OfACubeTheFacesAreExact) {
    Model model = test::empty_model();
    test::add_box(model, {-1, -1, -1}, {1, 1, 1});
    bake::Options options;
    options.layers = 1;
    const Measurement m = measure_model(model, options);
    EXPECT_EQ(m.captured_area, 1);
    EXPECT_EQ(m.coverage.share(), 1);
    EXPECT_LT(m.resolution_error.p95, 1e-6);
    // Edges are cut off within a texel, at most sqrt(6) 2/256 wide.
    EXPECT_LT(m.surface_distance.max, std::sqrt(6.0) * 2 / 256);
    EXPECT_GT(m.surface_distance.max, 1e-3);
}

// Tube of radius r = 0.4 about a circle of radius 1. A line from the centre touches the tube where the tube's
// angle t has cos t = -r; what lies beyond is outermost: the share of the area is the integral of (1 + r cos
// t) from -t to t over 2 pi.
TEST(MeasureMap, OfATorusOneLayerHoldsTheOutside) {
    Model model = test::empty_model();
    test::add_torus(model, 1, 0.4F, 256);
    bake::Options options = test::small_options();
    options.layers = 1;
    const Measurement one = measure_model(model, options);
    const double t = std::acos(-0.4);
    EXPECT_NEAR(one.captured_area, (t + 0.4 * std::sin(t)) / std::numbers::pi, 0.004);
    // The farthest point from what is captured is on the inner equator: its distance to the touching circle,
    // and at most a texel more.
    const double farthest = std::hypot(1 - 0.4 - (1 + 0.4 * std::cos(t)), 0.4 * std::sin(t)) / 1.4;
    EXPECT_GT(one.star_error.max, farthest - 0.005);
    EXPECT_LT(one.star_error.max, farthest + std::sqrt(6.0) * 2 / 64);
    EXPECT_DOUBLE_EQ(one.hausdorff(), one.surface_distance.max);
    options.layers = 2;
    const Measurement two = measure_model(model, options);
    EXPECT_GT(two.captured_area, 0.9999);
    EXPECT_LT(two.surface_distance.mean, 0.01);
}

TEST(MeasureMap, AnAffineFrameIsMeasuredInObjectSpace) {
    Model model = test::empty_model();
    test::add_box(model, {-4, -1, -0.5F}, {4, 1, 0.5F});
    bake::Options options = test::small_options();
    options.frame = bake::Frame::affine;
    const Measurement m = measure_model(model, options);
    EXPECT_EQ(m.captured_area, 1);
    EXPECT_TRUE(m.quantization.holds());
    EXPECT_LE(m.texel_distance.max, m.quantization.bound + 2e-7);
    EXPECT_LT(m.normal_angle.max, 0.01);
}

// Distances both ways as the Metro tool defines them (Cignoni et al. 1998), by brute force over all
// triangles.
TEST(MeasureMap, DistancesAreThoseOfBruteForce) {
    const Model model = test::random_soup(40, 21);
    bake::Options options = test::small_options();
    options.grid = options.color_grid = {Mapping::octahedral, 17, 17};
    const bake::Result baked = bake::bake_model(model, options);
    const Part& part = baked.map.map.parts.front();
    const Measurement m = measure_map(model, part, {500, 1, 0});

    const bake::CenteredModel centered = bake::center_model(model, {part.center, part.frame, part.radius});
    const auto distance = [](Vec3d p, const std::vector<Vec3f>& positions,
                             const std::vector<Triangle>& triangles) {
        double best = 1e300;
        for (const Triangle& t : triangles) {
            const Vec3d q = closest_point_on_triangle(p, to_double(positions[t.vertex[0]]),
                                                      to_double(positions[t.vertex[1]]),
                                                      to_double(positions[t.vertex[2]]));
            best = std::min(best, length(q - p));
        }
        return best;
    };
    std::size_t shells = 0;
    MapSurface surface;
    for (const TexelErrors& errors : m.texels) {
        const ImageView depth = surface_of(part, errors.layer, errors.side).depth;
        std::vector<double> radii;
        for (std::uint32_t y = 0; y < depth.height; ++y) {
            for (std::uint32_t x = 0; x < depth.width; ++x) {
                const double r = double(decode_depth(depth.format, depth.at(x, y)));
                radii.push_back(r);
                const double measured = double(errors.distance[std::size_t(y) * depth.width + x]);
                if (std::isnan(measured)) {
                    if (r > 0) ++shells;
                    continue;
                }
                const Vec3d p = normalize(sample_direction(errors.grid, {x, y})) * r;
                EXPECT_NEAR(measured, distance(p, centered.positions, model.triangles), 1e-7);
            }
        }
        append_surface(errors.grid, radii, part.frame, surface);
    }
    EXPECT_EQ(shells, m.shell_ends);
    EXPECT_GT(shells, 0U) << "random triangles bound no solid";
    std::vector<double> distances;
    for (const SurfaceSample& s : sample_surface(centered.positions, model.triangles, 500))
        distances.push_back(distance(s.position, surface.positions, surface.triangles));
    const Distribution expected = distribution(distances);
    EXPECT_NEAR(m.surface_distance.max, expected.max, 1e-6);
    EXPECT_NEAR(m.surface_distance.mean, expected.mean, 1e-6);
    EXPECT_NEAR(m.surface_distance.p95, expected.p95, 1e-6);
}

TEST(MeasureMap, DoesNotDependOnThreads) {
    const Model model = test::sample_model("concave");
    const bake::Result baked = bake::bake_model(model, test::small_options());
    const Measurement one = measure_map(model, baked.map.map.parts[0], {5000, 1, 0, 1});
    const Measurement two = measure_map(model, baked.map.map.parts[0], {5000, 1, 0, 2});
    EXPECT_EQ(one.texel_distance.rms, two.texel_distance.rms);
    EXPECT_EQ(one.surface_distance.rms, two.surface_distance.rms);
    EXPECT_EQ(one.captured_area, two.captured_area);
    EXPECT_EQ(one.normal_angle.rms, two.normal_angle.rms);
}

TEST(MeasureMap, ColorsAreMeasuredAsTheyWereSampled) {
    Model model = test::empty_model();
    test::add_sphere(model, {0, 0, 0}, 1, 16);
    test::add_random_texture(model, 64, 9);
    bake::Options options = test::small_options();
    options.color_grid = {Mapping::octahedral, 33, 33};
    options.samples = 3;
    const bake::Result baked = bake::bake_model(model, options);
    const Part& part = baked.map.map.parts.front();
    // Of nine samples a texel some meet an edge between triangles of different texture coordinates.
    EXPECT_LT(measure_map(model, part, {100, 3, 0}).color_difference.mean, 0.01);
    EXPECT_GT(measure_map(model, part, {100, 1, 0}).color_difference.mean, 1);
}

TEST(MeasureMap, AnEmptyMapIsItsCenter) {
    Model model = test::empty_model();
    test::add_sphere(model, {0, 0, 0}, 1, 16);
    bake::Options options = test::small_options();
    options.layers = 1;
    bake::Result baked = bake::bake_model(model, options);
    const ImageView depth = baked.map.map.parts[0].layers[0].outer.depth;
    for (std::uint32_t y = 0; y < depth.height; ++y)
        for (std::uint32_t x = 0; x < depth.width; ++x) test::clear_depth(baked.map, depth, {x, y});
    const Measurement m = measure_map(model, baked.map.map.parts[0], {100, 1, 0});
    EXPECT_EQ(m.coverage.missing, 65U * 65U);
    EXPECT_EQ(m.texel_distance.count, 0U);
    EXPECT_NEAR(m.surface_distance.mean, 1, 0.01);
}

TEST(MeasureMap, StopsWhenCancelled) {
    const Model model = test::sample_model("sphere");
    const bake::Result baked = bake::bake_model(model, test::small_options());
    EXPECT_THROW(measure_map(model, baked.map.map.parts[0], {1000, 1, 0}, [](double) { return false; }),
                 bake::Cancelled);
}

} // namespace
} // namespace spa::measure
