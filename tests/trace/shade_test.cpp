// SPDX-License-Identifier: Apache-2.0
// Stored colours and normals of hand-made maps.
#include "random.h"
#include "trace_image.h"

#include "../../libspa/core/element_format.h"
#include "../../shaders/spa_shade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spa::test {
namespace {

using shader::SpaHit;
using shader::SpaShade;

std::uint32_t rgba(unsigned red, unsigned green, unsigned blue, unsigned alpha) {
    return red | green << 8U | blue << 16U | alpha << 24U;
}

std::uint32_t normal_word(Vec3d normal) {
    std::array<std::byte, 4> code{};
    encode_normal(ElementFormat::oct16, normal, code.data());
    return std::bit_cast<std::uint32_t>(code);
}

SpaHit hit_at(const Grid& grid, Vec3d direction, std::uint32_t layer = 0, std::uint32_t side = SPA_OUTER) {
    SpaHit hit = shader::spa_no_hit();
    hit.map = shader::spa_place(std::uint32_t(grid.mapping),
                                {float(direction.x), float(direction.y), float(direction.z)});
    hit.normal = {0, 2, 0};
    hit.layer = layer;
    hit.side = side;
    return hit;
}

double one(TexelIndex /*texel*/) { return 1; }

TEST(TextShade, DecodesEveryColourCode) {
    for (unsigned code = 0; code < 256; ++code) {
        const float found = shader::spa_linear(float(code) * (1.0F / 255.0F));
        EXPECT_NEAR(double(found), double(srgb_to_linear(std::uint8_t(code))), 7e-7) << code;
        EXPECT_EQ(linear_to_srgb(found), code);
    }
    EXPECT_EQ(shader::spa_linear(0), 0);
}

TEST(TextShade, DecodesNormalsAsTheCoreDoes) {
    Random random(4);
    for (int i = 0; i < 10000; ++i) {
        const std::uint32_t word =
            i < 4 ? (i % 2 == 0 ? 0x7FFFU : 0x8001U) | (i < 2 ? 0x7FFF0000U : 0x80010000U)
                  : normal_word(random.direction());
        const auto bytes = std::bit_cast<std::array<std::byte, 4>>(word);
        const Vec3f expected = decode_normal(ElementFormat::oct16, bytes.data());
        const shader::float3 found = shader::spa_unit(shader::spa_normal_of(word));
        EXPECT_NEAR(found.x, expected.x, 5e-7);
        EXPECT_NEAR(found.y, expected.y, 5e-7);
        EXPECT_NEAR(found.z, expected.z, 5e-7);
    }
}

TEST(TextShade, WithoutImagesIsWhiteWithTheHitsNormal) {
    TraceImage image({Mapping::octahedral, 5, 5}, one);
    const SpaShade shade = shader::spa_shade(image.open(), hit_at(image.grid(), {1, 2, 3}));
    EXPECT_EQ(shade.color.x, 1);
    EXPECT_EQ(shade.coverage, 1);
    EXPECT_EQ(shade.normal.y, 1);
    EXPECT_EQ(shade.has_color, 0U);
    EXPECT_EQ(shade.has_normal, 0U);
}

TEST(TextShade, SamplesHaveTheirOwnColourAndNormal) {
    for (const Grid& grid : all_grids) {
        TraceImage image(grid, one);
        const auto color = [&](TexelIndex t) { return rgba(t.x * 3, t.y * 5, 200, 255); };
        image.set_colors(0, grid.width, grid.height, color);
        image.set_normals(0, grid.width, grid.height,
                          [&](TexelIndex t) { return normal_word(normalize(sample_direction(grid, t))); });
        const shader::SpaMap map = image.open();
        for (std::uint32_t y = 0; y < grid.height; ++y) {
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const Vec3d u = normalize(sample_direction(grid, {x, y}));
                const SpaShade shade = shader::spa_shade(map, hit_at(grid, u));
                const TexelIndex texel = canonical(grid, {x, y});
                EXPECT_NEAR(double(shade.color.x), double(srgb_to_linear(std::uint8_t(texel.x * 3))), 2e-4);
                EXPECT_NEAR(double(shade.color.y), double(srgb_to_linear(std::uint8_t(texel.y * 5))), 2e-4);
                EXPECT_NEAR(shade.coverage, 1, 1e-6);
                EXPECT_NEAR(double(shade.normal.x), u.x, 1e-4);
                EXPECT_NEAR(double(shade.normal.y), u.y, 1e-4);
                EXPECT_NEAR(double(shade.normal.z), u.z, 1e-4);
            }
        }
    }
}

// Red on one side of the octahedral border, blue on the other: between the samples beside the border the
// colour is the one on the border, from whichever side.
TEST(TextShade, BlendsOverTheOctahedralBorder) {
    const Grid grid{Mapping::octahedral, 9, 9};
    TraceImage image(grid, one);
    image.set_colors(0, 9, 9,
                     [](TexelIndex t) { return t.x < 4 ? rgba(255, 0, 0, 255) : rgba(0, 0, 255, 255); });
    const shader::SpaMap map = image.open();
    for (int i = 0; i <= 16; ++i) {
        // (s, 1) ~ (-s, 1) on the upper border.
        const auto s = float(i) / 16.0F;
        SpaHit left = shader::spa_no_hit();
        SpaHit right = shader::spa_no_hit();
        left.map = {0.5F - s / 2, 0};
        right.map = {0.5F + s / 2, 0};
        const SpaShade a = shader::spa_shade(map, left);
        const SpaShade b = shader::spa_shade(map, right);
        EXPECT_NEAR(a.color.x, b.color.x, 1e-6) << i;
        EXPECT_NEAR(a.color.z, b.color.z, 1e-6) << i;
    }
}

// White in one column, black elsewhere.
TEST(TextShade, BlendsOverTheLatlongSeam) {
    const Grid grid{Mapping::latlong, 8, 4};
    TraceImage image(grid, one);
    image.set_colors(0, 8, 4,
                     [](TexelIndex t) { return t.x == 7 ? rgba(255, 255, 255, 255) : rgba(0, 0, 0, 255); });
    const shader::SpaMap map = image.open();
    SpaHit hit = shader::spa_no_hit();
    for (const float x : {0.0F, 1.0F}) { // the seam, from both sides
        hit.map = {x, 0.375F};
        EXPECT_NEAR(shader::spa_shade(map, hit).color.x, 0.5F, 1e-5);
    }
    hit.map = {0.5F / 8, 0.375F};
    EXPECT_NEAR(shader::spa_shade(map, hit).color.x, 0, 1e-5);
    hit.map = {7.5F / 8, 0.375F};
    EXPECT_NEAR(shader::spa_shade(map, hit).color.x, 1, 1e-5);
    // Over the pole stands the column half a turn away: column 3 sees column 7.
    hit.map = {3.5F / 8, 0};
    EXPECT_NEAR(shader::spa_shade(map, hit).color.x, 0.5F, 1e-5);
}

TEST(TextShade, FiltersInLinearLightWeightedByCoverage) {
    const Grid grid{Mapping::latlong, 8, 4};
    TraceImage image(grid, one);
    // Column 2: red, covered; column 3: green, coverage 51/255; column 4: blue, none.
    image.set_colors(0, 8, 4, [](TexelIndex t) {
        if (t.x == 2) return rgba(255, 0, 0, 255);
        if (t.x == 3) return rgba(0, 255, 0, 51);
        return rgba(0, 0, 255, 0);
    });
    const shader::SpaMap map = image.open();
    SpaHit hit = shader::spa_no_hit();
    hit.map = {3.0F / 8, 0.375F}; // halfway between columns 2 and 3
    SpaShade shade = shader::spa_shade(map, hit);
    EXPECT_NEAR(shade.coverage, 0.6, 1e-5);
    EXPECT_NEAR(shade.color.x, 1 / 1.2, 1e-5);
    EXPECT_NEAR(shade.color.y, 0.2 / 1.2, 1e-5);
    hit.map = {4.0F / 8, 0.375F}; // between 3 and 4: green alone
    shade = shader::spa_shade(map, hit);
    EXPECT_NEAR(shade.coverage, 0.1, 1e-5);
    EXPECT_NEAR(shade.color.y, 1, 1e-5);
    EXPECT_NEAR(shade.color.z, 0, 1e-5);
    hit.map = {6.0F / 8, 0.375F}; // no coverage at all: the colours as they are
    shade = shader::spa_shade(map, hit);
    EXPECT_EQ(shade.coverage, 0);
    EXPECT_NEAR(shade.color.z, 1, 1e-5);
}

TEST(TextShade, LeavesOutNormalsWithoutSurface) {
    const Grid grid{Mapping::octahedral, 5, 5};
    TraceImage image(grid, one);
    image.set_normals(0, 5, 5, [](TexelIndex t) { return t.x < 2 ? SPA_NO_NORMAL : normal_word({1, 0, 0}); });
    const shader::SpaMap map = image.open();
    SpaHit hit = hit_at(grid, {0, 0, 1});
    hit.map = {0.375F, 0.5F}; // between a sample without and one with
    SpaShade shade = shader::spa_shade(map, hit);
    EXPECT_EQ(shade.has_normal, 1U);
    EXPECT_NEAR(shade.normal.x, 1, 1e-6);
    hit.map = {0.125F, 0.5F}; // none anywhere: the hit's own
    shade = shader::spa_shade(map, hit);
    EXPECT_EQ(shade.has_normal, 0U);
    EXPECT_EQ(shade.normal.y, 1);
}

TEST(TextShade, TakesTheSurfaceThatWasHit) {
    const Grid grid{Mapping::octahedral, 5, 5};
    TraceImage image(grid, one, 4);
    const auto plain = [](std::uint32_t word) { return [word](TexelIndex /*texel*/) { return word; }; };
    image.set_colors(0, 5, 5, plain(rgba(255, 0, 0, 255)));
    image.set_colors(1, 3, 3, plain(rgba(0, 255, 0, 255))); // of a size of its own
    image.set_colors(2, 5, 5, plain(rgba(0, 0, 255, 255))); // and no inner one
    image.set_normals(2, 9, 9, plain(normal_word({0, 0, -1})));
    const shader::SpaMap map = image.open();
    const Vec3d u{0.3, -0.4, 0.2};
    EXPECT_EQ(shader::spa_shade(map, hit_at(grid, u, 0, SPA_OUTER)).color.x, shader::spa_linear(1));
    EXPECT_NEAR(shader::spa_shade(map, hit_at(grid, u, 0, SPA_INNER)).color.y, 1, 1e-6);
    EXPECT_NEAR(shader::spa_shade(map, hit_at(grid, u, 0, SPA_WALL)).color.x, 1, 1e-6);
    EXPECT_NEAR(shader::spa_shade(map, hit_at(grid, u, 1, SPA_OUTER)).color.z, 1, 1e-6);
    const SpaShade inner = shader::spa_shade(map, hit_at(grid, u, 1, SPA_INNER)); // the outer one's stand in
    EXPECT_NEAR(inner.color.z, 1, 1e-6);
    EXPECT_NEAR(inner.normal.z, -1, 1e-6);
    EXPECT_EQ(shader::spa_shade(map, hit_at(grid, u, 0, SPA_OUTER)).has_normal, 0U);
    // Layers that are not there: nothing is read that is not there.
    EXPECT_NEAR(shader::spa_shade(map, hit_at(grid, u, 77, SPA_INNER)).color.y, 1, 1e-6);
}

TEST(TextShade, OfARecordOfGarbageIsFinite) {
    const Grid grid{Mapping::latlong, 8, 4};
    TraceImage image(grid, one);
    image.set_colors(0, 8, 4, [](TexelIndex) { return 0xFFFFFFFFU; });
    const shader::SpaMap map = image.open();
    SpaHit hit = shader::spa_no_hit();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    hit.map = {nan, -nan};
    hit.normal = {nan, 0, 0};
    const SpaShade shade = shader::spa_shade(map, hit);
    EXPECT_TRUE(std::isfinite(shade.color.x));
    EXPECT_EQ(shade.normal.x, 0);
}

} // namespace
} // namespace spa::test
