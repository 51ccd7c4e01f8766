// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/lods.h"

#include "../../samples/samples.h"

#include <gtest/gtest.h>

namespace spa::measure {
namespace {

std::vector<Lod> ladder(const Model& model, const std::vector<double>& errors) {
    return simplify(model.positions, model.normals, model.triangles, errors);
}

TEST(Lods, HaveMoreTrianglesWhereLessErrorIsAllowed) {
    const Model model = samples::make_sample("smooth", 3);
    const auto lods = ladder(model, {0.1, 0.03, 0.01, 0.003, 0.001});
    ASSERT_EQ(lods.size(), 5U);
    std::size_t triangles = 10;
    for (const Lod& lod : lods) {
        EXPECT_GT(lod.triangles.size(), triangles);
        triangles = lod.triangles.size();
        EXPECT_LE(lod.error, lod.target_error * 1.001);
        EXPECT_EQ(lod.normals.size(), lod.positions.size());
    }
    EXPECT_LT(triangles, model.triangles.size());
}

TEST(Lods, HoldNoVertexThatNoTriangleUses) {
    const Model model = samples::make_sample("torus", 3);
    for (const Lod& lod : ladder(model, {0.05, 0.005})) {
        std::vector<bool> used(lod.positions.size());
        for (const Triangle& t : lod.triangles)
            for (const std::uint32_t v : t.vertex) used.at(v) = true;
        EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    }
} // Neither seams nor creases are in the way; what a crease looks like is left to the triangles.
TEST(Lods, UniteWhatLiesAtOnePlace) {
    const Model cube = samples::make_sample("cube", 3);
    const auto lods = ladder(cube, {0.01});
    EXPECT_EQ(lods[0].triangles.size(), 12U);
    EXPECT_EQ(lods[0].positions.size(), 8U);
    for (const Vec3f& normal : lods[0].normals) EXPECT_EQ(normal, Vec3f{});
    const auto rings = ladder(samples::make_sample("torus", 3), {0.01});
    for (const Vec3f& normal : rings[0].normals) EXPECT_NEAR(length(normal), 1, 1e-5);
}

TEST(Lods, OfNothingAreEmpty) {
    const auto lods = simplify({}, {}, {}, std::vector<double>{0.1});
    ASSERT_EQ(lods.size(), 1U);
    EXPECT_TRUE(lods[0].triangles.empty());
}

} // namespace
} // namespace spa::measure
