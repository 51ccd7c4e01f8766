// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/bake/intersect_block.h"

#include <gtest/gtest.h>

#include <random>

namespace spa::bake {
namespace {

// Wide and narrow triangles, some through directions of samples, on both sides of the origin.
CenteredModel triangles(Model& model, const SampleDirections& directions, const Grid& grid) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::uniform_int_distribution<std::uint32_t> column(0, grid.width - 1), row(0, grid.height - 1);
    for (std::uint32_t t = 0; t < 300; ++t) {
        const Vec3f center{unit(random), unit(random), unit(random)};
        const float size = t % 3 == 0 ? 0.02F : 0.7F;
        for (int k = 0; k < 3; ++k) {
            model.positions.push_back(t % 5 == 0 && k == 0
                                          ? to_float(directions(column(random), row(random)) * 0.5)
                                          : center * 0.5F +
                                                Vec3f{unit(random), unit(random), unit(random)} * size);
        }
        model.triangles.push_back({{3 * t, 3 * t + 1, 3 * t + 2}});
    }
    CenteredModel centered;
    centered.model = &model;
    centered.positions = model.positions;
    return centered;
}

TEST(IntersectBlock, GivesTheBitsOfOneRayAtATime) {
    for (const Grid& grid : {Grid{Mapping::latlong, 83, 41}, Grid{Mapping::octahedral, 65, 65}}) {
        const SampleDirections directions(grid);
        Model model;
        const CenteredModel centered = triangles(model, directions, grid);
        std::size_t hits = 0;
        for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
            const RaySetup setup(centered, model.triangles[t]);
            std::vector<double> found(std::size_t(grid.width) * grid.height, -1);
            each_row(setup, directions, {1, 0, grid.width - 1, grid.height - 2},
                     [&](TexelIndex at, const double* radius, std::uint32_t count) {
                         for (std::uint32_t i = 0; i < count; ++i)
                             found[std::size_t(at.y) * grid.width + at.x + i] = radius[i];
                     });
            for (std::uint32_t y = 0; y + 1 < grid.height; ++y) {
                for (std::uint32_t x = 1; x < grid.width; ++x) {
                    RayHit hit;
                    const bool meets = intersect(setup, directions(x, y), hit);
                    ASSERT_EQ(found[std::size_t(y) * grid.width + x], meets ? hit.radius : 0)
                        << t << " at " << x << ' ' << y;
                    hits += meets ? 1 : 0;
                }
            }
            EXPECT_EQ(found[0], -1); // outside the rectangle
        }
        EXPECT_GT(hits, 1000U);
    }
}

TEST(IntersectBlock, KeepsTheOutermostAndTheSmallestTriangle) {
    std::vector<OutermostHit> hits(7);
    const std::vector<double> first{0.5, 0, 0.25, 0.75, 0, 1, 0.5}, second{0.5, 0.5, 0.5, 0.5, 0, 0.5, 0};
    keep_outermost_row(first.data(), 7, 4, hits.data());
    keep_outermost_row(second.data(), 7, 3, hits.data());
    const auto expect = [&](std::size_t i, float radius, std::uint32_t triangle) {
        EXPECT_EQ(hits[i].radius(), radius) << i;
        EXPECT_EQ(hits[i].triangle(), triangle) << i;
    };
    expect(0, 0.5F, 3);
    expect(1, 0.5F, 3);
    expect(2, 0.5F, 3);
    expect(3, 0.75F, 4);
    EXPECT_TRUE(hits[4].empty());
    expect(5, 1, 4);
    expect(6, 0.5F, 4);
}

} // namespace
} // namespace spa::bake
