// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/surface_samples.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spa::measure {
namespace {

TEST(SurfaceSamples, LieInTheirTriangles) {
    const Model model = test::random_soup(50, 1);
    for (const SurfaceSample& s : sample_surface(model.positions, model.triangles, 2000)) {
        EXPECT_NEAR(s.barycentric.x + s.barycentric.y + s.barycentric.z, 1, 1e-12);
        EXPECT_GE(std::min({s.barycentric.x, s.barycentric.y, s.barycentric.z}), 0);
        Vec3d p;
        const double w[3] = {s.barycentric.x, s.barycentric.y, s.barycentric.z};
        for (unsigned k = 0; k < 3; ++k)
            p = p + to_double(model.positions[model.triangles[s.triangle].vertex[k]]) * w[k];
        EXPECT_LT(length(p - s.position), 1e-12);
    }
}

// Two quads of areas 1 and 3, the first of many small triangles.
TEST(SurfaceSamples, AreSpreadByArea) {
    Model model = test::empty_model();
    for (int i = 0; i < 10; ++i) {
        const float x = float(i) / 10;
        test::add_quad(model, {x, 0, 0}, {x + 0.1F, 0, 0}, {x + 0.1F, 1, 0}, {x, 1, 0});
    }
    test::add_quad(model, {0, 0, 1}, {3, 0, 1}, {3, 1, 1}, {0, 1, 1});
    int first = 0;
    int left = 0; // of x = 1.5, on the large quad
    const auto samples = sample_surface(model.positions, model.triangles, 4000);
    ASSERT_EQ(samples.size(), 4000U);
    for (const SurfaceSample& s : samples) {
        if (s.position.z < 0.5)
            ++first;
        else if (s.position.x < 1.5)
            ++left;
    }
    EXPECT_NEAR(first, 1000, 2);
    EXPECT_NEAR(left, 1500, 60);
}

TEST(SurfaceSamples, OfNoAreaAreNone) {
    Model model = test::empty_model();
    model.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    model.triangles = {{{0, 1, 2}}, {{0, 0, 0}}};
    EXPECT_TRUE(sample_surface(model.positions, model.triangles, 10).empty());
}

} // namespace
} // namespace spa::measure
