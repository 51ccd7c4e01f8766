// SPDX-License-Identifier: Apache-2.0
// Several crossings of one sample: their order, what counts as one, and both facings.
#include "fixture.h"

#include "../support/shapes.h"

namespace spa::test {
namespace {

class OrbitPeeling : public OrbitTest {
protected:
    // Squares at the given distances in front of the centre, across +Z; negative: seen from behind.
    static Model squares(const std::vector<float>& distances) {
        Model model = empty_model();
        for (const float z : distances) {
            const float d = std::abs(z);
            if (z > 0)
                add_quad(model, {-0.4F, -0.3F, d}, {0.4F, -0.3F, d}, {0.4F, 0.5F, d}, {-0.4F, 0.5F, d});
            else
                add_quad(model, {-0.4F, -0.3F, d}, {-0.4F, 0.5F, d}, {0.4F, 0.5F, d}, {0.4F, -0.3F, d});
        }
        return model;
    }

    // The crossings along +Z.
    [[nodiscard]] std::vector<bake::Crossing> along_z(const Model& model, bool layers = true) const {
        bake::CenteredModel centered;
        centered.model = &model;
        centered.positions = model.positions;
        centered.normals = model.normals;
        const bake::CrossingGrid grid = cast(centered, octahedral(4), layers);
        const std::size_t middle = 2 * 5 + 2;
        return {grid.crossings.begin() + std::ptrdiff_t(grid.first[middle]),
                grid.crossings.begin() + std::ptrdiff_t(grid.first[middle + 1])};
    }
};

TEST_F(OrbitPeeling, OutermostFirst) {
    const auto found = along_z(squares({0.3F, -0.9F, 0.5F, -0.4F, 0.7F}));
    ASSERT_EQ(found.size(), 5U);
    const float expected[] = {0.9F, 0.7F, 0.5F, 0.4F, 0.3F};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_FLOAT_EQ(found[i].radius, expected[i]);
        EXPECT_EQ(found[i].front_facing, i != 0 && i != 3);
        EXPECT_EQ(found[i].normal.z, found[i].front_facing ? 1.0F : -1.0F);
    }
}

TEST_F(OrbitPeeling, OutermostOfEitherFacing) {
    const auto front = along_z(squares({0.3F, -0.6F, 0.8F}), false);
    ASSERT_EQ(front.size(), 1U);
    EXPECT_FLOAT_EQ(front[0].radius, 0.8F);
    const auto back = along_z(squares({0.3F, -0.6F, 0.5F}), false);
    ASSERT_EQ(back.size(), 1U);
    EXPECT_FLOAT_EQ(back[0].radius, 0.6F);
    EXPECT_FALSE(back[0].front_facing);
}

TEST_F(OrbitPeeling, DuplicatesAreOneOfTheSmallestIndex) {
    for (const bool layers : {false, true}) {
        const auto found = along_z(squares({0.2F, 0.5F, 0.5F, 0.5F}), layers);
        ASSERT_EQ(found.size(), layers ? 2U : 1U);
        EXPECT_EQ(found[0].triangle / 2, 1U);
    }
}

TEST_F(OrbitPeeling, DoubleFacesAreTwo) {
    const auto found = along_z(squares({-0.5F, 0.5F}));
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(found[0].front_facing);
    EXPECT_FALSE(found[1].front_facing);
    EXPECT_EQ(found[0].radius, found[1].radius);
}

TEST_F(OrbitPeeling, MergeDistance) {
    // The farther one has the larger index: within the distance the smaller index wins, with its own radius.
    const auto one = along_z(squares({0.5F, 0.5F + 0.6e-6F}));
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].triangle / 2, 0U);
    EXPECT_EQ(one[0].radius, 0.5F);
    const auto two = along_z(squares({0.5F, 0.5F + 1.5e-6F}));
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].triangle / 2, 1U);
}

TEST_F(OrbitPeeling, BehindTheCentreIsAnotherSample) {
    Model model = squares({0.5F});
    add_quad(model, {-0.4F, -0.4F, -0.6F}, {-0.4F, 0.4F, -0.6F}, {0.4F, 0.4F, -0.6F}, {0.4F, -0.4F, -0.6F});
    EXPECT_EQ(along_z(model).size(), 1U);
}

// 60 shells: each round of peeling must leave nothing of the round before.
TEST_F(OrbitPeeling, ManyLayers) {
    std::vector<float> distances;
    for (int i = 1; i <= 60; ++i) distances.push_back(float(i) / 61.0F * (i % 3 == 0 ? -1.0F : 1.0F));
    EXPECT_EQ(along_z(squares(distances)).size(), 60U);
}

TEST_F(OrbitPeeling, MirroredFrameSwapsFacings) {
    const Model model = random_textured_soup(60, 3);
    bake::CenteredModel centered = normalized(model);
    const Grid grid = octahedral(32);
    const bake::CrossingGrid plain = cast(centered, grid, true);
    centered.mirrored = true;
    const bake::CrossingGrid mirrored = cast(centered, grid, true);
    ASSERT_EQ(plain.crossings.size(), mirrored.crossings.size());
    for (std::size_t i = 0; i < plain.crossings.size(); ++i) {
        EXPECT_NE(plain.crossings[i].front_facing, mirrored.crossings[i].front_facing);
        EXPECT_EQ(plain.crossings[i].triangle, mirrored.crossings[i].triangle);
        EXPECT_EQ(plain.crossings[i].normal, mirrored.crossings[i].normal);
    }
}

} // namespace
} // namespace spa::test
