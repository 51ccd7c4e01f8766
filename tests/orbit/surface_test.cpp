// SPDX-License-Identifier: Apache-2.0
// Colour and alpha on a square across +Z whose uv run from 0 to 1: what each sample must show is plain to
// see.
#include "fixture.h"

#include "../support/shapes.h"

#include <cmath>

namespace spa::test {
namespace {

using Color = std::array<std::uint8_t, 4>;

class OrbitSurface : public OrbitTest {
protected:
    void SetUp() override {
        OrbitTest::SetUp();
        model = empty_model();
        add_quad(model, {-1, -1, 0.5F}, {1, -1, 0.5F}, {1, 1, 0.5F}, {-1, 1, 0.5F});
        model.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        Texture texture;
        texture.mips.push_back(
            {2,
             2,
             {Color{255, 0, 0, 255}, Color{0, 255, 0, 128}, Color{0, 0, 255, 40}, Color{255, 255, 255, 0}}});
        build_mips(texture);
        model.textures.push_back(texture);
        model.materials[0].texture = 0;
        model.materials[0].nearest = true;
    }

    // The crossing of the sample whose direction meets the square next to uv.
    [[nodiscard]] std::vector<bake::Crossing> at(Vec2d uv) const {
        bake::CenteredModel centered;
        centered.model = &model;
        for (const Vec3f p : model.positions) centered.positions.push_back(p * 0.6F);
        centered.normals = model.normals;
        const Grid grid = octahedral(32);
        const Vec2d position = position_of(grid, {2 * uv.x - 1, 1 - 2 * uv.y, 0.5});
        const std::size_t sample =
            std::size_t(std::lround(position.y)) * grid.width + std::size_t(std::lround(position.x));
        const bake::CrossingGrid crossings = cast(centered, grid, true);
        return {crossings.crossings.begin() + std::ptrdiff_t(crossings.first[sample]),
                crossings.crossings.begin() + std::ptrdiff_t(crossings.first[sample + 1])};
    }
    [[nodiscard]] Color color_at(Vec2d uv) const {
        const auto crossings = at(uv);
        EXPECT_EQ(crossings.size(), 1U);
        return crossings.empty() ? Color{} : crossings[0].color;
    }

    Model model;
};

TEST_F(OrbitSurface, PictureIsUprightAndOpaque) {
    EXPECT_EQ(color_at({0.25, 0.25}), (Color{255, 0, 0, 255}));
    EXPECT_EQ(color_at({0.75, 0.25}), (Color{0, 255, 0, 255}));
    EXPECT_EQ(color_at({0.25, 0.75}), (Color{0, 0, 255, 255}));
    EXPECT_EQ(color_at({0.75, 0.75}), (Color{255, 255, 255, 255}));
}

TEST_F(OrbitSurface, Repeat) {
    for (Vec2f& uv : model.uvs) uv = {uv.x * 2 - 1, uv.y * 3};
    EXPECT_EQ(color_at({0.125, 0.25 / 3}), (Color{255, 0, 0, 255}));
    EXPECT_EQ(color_at({0.375, 1.75 / 3}), (Color{255, 255, 255, 255}));
}

TEST_F(OrbitSurface, MirroredRepeat) {
    model.materials[0].wrap_u = model.materials[0].wrap_v = Wrap::mirrored_repeat;
    for (Vec2f& uv : model.uvs) uv = {uv.x * 2, uv.y * 2};
    EXPECT_EQ(color_at({0.875, 0.125}), (Color{255, 0, 0, 255}));
    EXPECT_EQ(color_at({0.875, 0.375}), (Color{0, 0, 255, 255}));
    EXPECT_EQ(color_at({0.625, 0.125}), (Color{0, 255, 0, 255}));
}

TEST_F(OrbitSurface, ClampToEdge) {
    model.materials[0].wrap_u = model.materials[0].wrap_v = Wrap::clamp_to_edge;
    for (Vec2f& uv : model.uvs) uv = {uv.x * 4 - 2, uv.y * 4 - 2};
    EXPECT_EQ(color_at({0.1, 0.1}), (Color{255, 0, 0, 255}));
    EXPECT_EQ(color_at({0.9, 0.9}), (Color{255, 255, 255, 255}));
}

TEST_F(OrbitSurface, MaskHasHoles) {
    model.materials[0].alpha_mode = AlphaMode::mask;
    model.materials[0].alpha_cutoff = 0.3F;
    EXPECT_EQ(color_at({0.75, 0.25}), (Color{0, 255, 0, 255}));
    EXPECT_TRUE(at({0.25, 0.75}).empty());
    EXPECT_TRUE(at({0.75, 0.75}).empty());
    model.materials[0].base_color.w = 0.5F;
    EXPECT_TRUE(at({0.75, 0.25}).empty());
    EXPECT_EQ(at({0.25, 0.25}).size(), 1U);
}

TEST_F(OrbitSurface, BlendKeepsItsAlpha) {
    model.materials[0].alpha_mode = AlphaMode::blend;
    EXPECT_EQ(color_at({0.75, 0.25}), (Color{0, 255, 0, 128}));
    EXPECT_EQ(color_at({0.25, 0.75}), (Color{0, 0, 255, 40}));
    EXPECT_TRUE(at({0.75, 0.75}).empty());
}

// Two thirds red in linear light, so that a product in sRGB would show.
TEST_F(OrbitSurface, FactorsMultiplyInLinearLight) {
    model.materials[0].base_color = {0.5F, 1, 1, 1};
    model.colors.assign(4, {0.5F, 0.5F, 1, 1});
    EXPECT_EQ(color_at({0.25, 0.25}), (Color{linear_to_srgb(0.25F), 0, 0, 255}));
    model.materials[0].texture = no_index;
    EXPECT_EQ(color_at({0.25, 0.25}), (Color{linear_to_srgb(0.25F), linear_to_srgb(0.5F), 255, 255}));
}

TEST_F(OrbitSurface, BilinearInLinearLight) {
    model.materials[0].nearest = false;
    const Color middle = color_at({0.5, 0.25});
    EXPECT_NEAR(middle[0], linear_to_srgb(0.5F), 2);
    EXPECT_NEAR(middle[1], linear_to_srgb(0.5F), 2);
    EXPECT_EQ(middle[2], 0);
}

// A texture far finer than the samples comes from its small levels, nearest or not.
TEST_F(OrbitSurface, FineTexturesAreAveraged) {
    Texture checker;
    checker.mips.push_back({1024, 1024, {}});
    for (std::uint32_t i = 0; i < 1024 * 1024; ++i) {
        const std::uint8_t c = ((i + i / 1024) % 2 == 0) ? 255 : 0;
        checker.mips[0].pixels.push_back({c, c, c, 255});
    }
    build_mips(checker);
    model.textures[0] = checker;
    for (Vec2f& uv : model.uvs) uv = {uv.x * 3, uv.y * 3};
    for (const bool nearest : {false, true}) {
        model.materials[0].nearest = nearest;
        for (const Vec2d uv : {Vec2d{0.31, 0.47}, Vec2d{0.5, 0.5}, Vec2d{0.77, 0.21}}) {
            EXPECT_NEAR(color_at(uv)[0], linear_to_srgb(0.5F), 1);
        }
    }
}

// Textures change from triangle to triangle, and with them the draw calls; the order of triangles holds.
TEST_F(OrbitSurface, ManyTextures) {
    for (int i = 1; i < 40; ++i) {
        Texture plain;
        plain.mips.push_back({1, 1, {Color{std::uint8_t(i), std::uint8_t(5 * i), 0, 255}}});
        model.textures.push_back(plain);
        Material material;
        material.texture = std::uint32_t(i);
        model.materials.push_back(material);
        const float d = 0.5F + 0.01F * float(i);
        add_quad(model, {-1, -1, d}, {1, -1, d}, {1, 1, d}, {-1, 1, d});
        for (int k = 0; k < 4; ++k) model.uvs.push_back({0, 0});
        model.triangle_materials[model.triangles.size() - 1] = std::uint32_t(i);
        model.triangle_materials[model.triangles.size() - 2] = std::uint32_t(i);
    }
    const auto crossings = at({0.25, 0.25});
    ASSERT_EQ(crossings.size(), 40U);
    for (int i = 1; i < 40; ++i) {
        EXPECT_EQ(crossings[std::size_t(39 - i)].color,
                  (Color{std::uint8_t(i), std::uint8_t(5 * i), 0, 255}));
    }
}

} // namespace
} // namespace spa::test
