// SPDX-License-Identifier: Apache-2.0
// Shapes of a search against those of a bake, byte for byte.
#include "../../libspa/plan/candidate.h"
#include "../../libspa/plan/shape_baker.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spa::plan {
namespace {

bool same(std::span<const std::byte> a, std::span<const std::byte> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

void expect_same_shape(const Part& a, const Part& b) {
    EXPECT_TRUE(same(a.mixed, b.mixed));
    EXPECT_TRUE(same(a.folds, b.folds));
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.center_inside, b.center_inside);
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t k = 0; k < a.layers.size(); ++k) {
        for (const auto& [p, q] : {std::pair(a.layers[k].outer, b.layers[k].outer),
                                   std::pair(a.layers[k].inner, b.layers[k].inner)}) {
            EXPECT_EQ(p.depth.width, q.depth.width);
            EXPECT_TRUE(same(p.depth.bytes, q.depth.bytes));
            EXPECT_TRUE(same(p.normal.bytes, q.normal.bytes));
        }
    }
}

// A torus beside a box: the centre is outside of both.
Model pieces() {
    Model model = test::empty_model();
    test::add_torus(model, 1, 0.35F, 32);
    test::add_box(model, {1.5F, 0.2F, 0.1F}, {1.9F, 0.9F, 0.8F});
    return model;
}

bake::Options options_of_size(std::uint32_t cells, std::uint32_t layers) {
    bake::Options options;
    options.grid = options.color_grid = grid_of(Mapping::octahedral, cells);
    options.layers = layers;
    return options;
}

TEST(ShapeBaker, GivesWhatABakeGives) {
    const Model model = pieces();
    const Components components = find_components(model);
    for (const bake::Frame frame : {bake::Frame::sphere, bake::Frame::affine}) {
        bake::Options options;
        options.frame = frame;
        ShapeBaker baker(model, components, options, {});
        // Up and down, within a family of sizes and out of it.
        for (const std::uint32_t cells : {16U, 64U, 8U, 48U, 160U, 80U}) {
            for (const std::uint32_t layers : {1U, 2U, 3U}) {
                SCOPED_TRACE(std::to_string(cells) + " cells, " + std::to_string(layers) + " layers");
                options = options_of_size(cells, layers);
                options.frame = frame;
                const Shape shape = baker.bake(options);
                const bake::Result baked = bake::bake_model(model, options);
                expect_same_shape(shape.map.map.parts.front(), baked.map.map.parts.front());
                if (layers > 1) {
                    EXPECT_EQ(shape.truncated, baked.report.truncated_samples > 0);
                }
            }
        }
    }
}

TEST(ShapeBaker, FiltersAlphaForTheSizeAtHand) {
    Model model = pieces();
    test::add_random_texture(model, 64, 5);
    for (Texture& texture : model.textures) {
        for (Image& image : texture.mips)
            for (std::size_t i = 0; i < image.pixels.size(); ++i)
                image.pixels[i][3] = std::uint8_t(i * 37 % 256);
        build_mips(texture);
    }
    for (Material& material : model.materials) material.alpha_mode = AlphaMode::mask;
    const Components components = find_components(model);
    ShapeBaker baker(model, components, {}, {});
    for (const std::uint32_t cells : {32U, 16U}) {
        const bake::Options options = options_of_size(cells, 2);
        expect_same_shape(baker.bake(options).map.map.parts.front(),
                          bake::bake_model(model, options).map.map.parts.front());
    }
}

} // namespace
} // namespace spa::plan
