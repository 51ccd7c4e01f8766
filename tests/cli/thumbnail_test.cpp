// SPDX-License-Identifier: Apache-2.0
// Thumbnails of shapes whose pictures follow from geometry.
#include "../../tools/thumbnail.h"

#include "../../libspa/bake/bake.h"
#include "../support/shapes.h"
#include "../trace/function_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace spa::test {
namespace {

using tools::Picture;
using tools::Rgb;
using tools::thumbnail;
using tools::thumbnail_background;

constexpr std::uint32_t size = 96;
constexpr Grid octahedral{Mapping::octahedral, 257, 257};
constexpr Grid latlong{Mapping::latlong, 640, 480};

Picture picture_of(const Part& part) {
    SphericalMap map;
    map.parts.push_back(part);
    return thumbnail(map, size);
}

FunctionMap sphere(const Grid& grid, Vec3d color) {
    FunctionMap map(grid, [](Vec3d) { return 0.8; });
    map.set_normals([](Vec3d u) { return u; });
    map.set_colors([color](Vec3d) { return color; });
    return map;
}

Vec3d main_axis(Vec3d u) {
    const Vec3d a{std::abs(u.x), std::abs(u.y), std::abs(u.z)};
    if (a.x >= a.y && a.x >= a.z) return {std::copysign(1.0, u.x), 0, 0};
    if (a.y >= a.z) return {0, std::copysign(1.0, u.y), 0};
    return {0, 0, std::copysign(1.0, u.z)};
}

// +X is green, +Y blue, +Z red; the faces that are not to be seen are white.
FunctionMap cube(const Grid& grid) {
    FunctionMap map(grid, [](Vec3d u) { return 0.5 / std::abs(dot(u, main_axis(u))); });
    map.set_normals(main_axis);
    map.set_colors([](Vec3d u) {
        const Vec3d axis = main_axis(u);
        if (axis.x + axis.y + axis.z < 0) return Vec3d{1, 1, 1};
        return Vec3d{axis.z, axis.x, axis.y};
    });
    return map;
}

std::size_t pixels_of_object(const Picture& picture) {
    return picture.pixels.size() -
           std::size_t(std::count(picture.pixels.begin(), picture.pixels.end(), thumbnail_background));
}

int difference(Rgb a, Rgb b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

// The share of pixels that differ by more than `codes`.
double differing(const Picture& a, const Picture& b, int codes) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += difference(a.pixels[i], b.pixels[i]) > codes ? 1 : 0;
    return double(count) / double(a.pixels.size());
}

class ThumbnailOf : public testing::TestWithParam<const char*> {
protected:
    static Grid grid() { return std::string(GetParam()) == "latlong" ? latlong : octahedral; }
};

INSTANTIATE_TEST_SUITE_P(Mappings, ThumbnailOf, testing::Values("octahedral", "latlong"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(ThumbnailOf, SphereFillsACircleAndIsLitFromTheUpperLeft) {
    FunctionMap map = sphere(grid(), {1, 1, 1});
    const Picture picture = picture_of(map.part());
    const double radius = size / 2.0 / 1.06; // of the circle; a twentieth of the width is left free
    const double area = std::numbers::pi * radius * radius;
    // Pixels on the outline count in full: half a pixel more all around.
    EXPECT_NEAR(double(pixels_of_object(picture)), area + std::numbers::pi * radius, 0.01 * area);

    // In the middle the normal points to the viewer; the light's direction is (-1/2, 1/2, 1), not normalised.
    const float middle = 0.1F + 0.75F / std::sqrt(1.5F);
    EXPECT_LE(std::abs(int(picture.at(size / 2, size / 2)[0]) - int(linear_to_srgb(middle))), 1);
    double upper_left = 0, lower_right = 0;
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
            const Rgb here = picture.at(x, y);
            (x + y < size ? upper_left : lower_right) += here[0];
            EXPECT_LE(difference(here, picture.at(y, x)), 4) << x << ", " << y;
        }
    EXPECT_GT(upper_left, 1.2 * lower_right);
}

TEST_P(ThumbnailOf, CubeShowsFrontLeftRightSideRightAndTopAbove) {
    FunctionMap map = cube(grid());
    const Picture picture = picture_of(map.part());
    const auto looks = [&](double x, double y, std::size_t channel) {
        const Rgb c = picture.at(std::uint32_t(x * size), std::uint32_t(y * size));
        return c[channel] > 80 && c[(channel + 1) % 3] < 10 && c[(channel + 2) % 3] < 10;
    };
    EXPECT_TRUE(looks(0.35, 0.6, 0));
    EXPECT_TRUE(looks(0.85, 0.5, 1));
    EXPECT_TRUE(looks(0.5, 0.15, 2));
    // The hidden faces stay hidden. Triangles over an edge of the cube mix colours.
    const auto white = std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                     [](Rgb c) { return c[0] > 128 && c[1] > 128 && c[2] > 128; });
    EXPECT_LT(white, 10);
}

TEST_P(ThumbnailOf, TorusHasAHoleWithTwoLayers) {
    Model model = empty_model();
    add_torus(model, 1, 0.25F, 64);
    bake::Options options;
    options.grid = options.color_grid = grid();
    for (const std::uint32_t layers : {1U, 2U}) {
        options.layers = layers;
        const bake::Result result = bake::bake_model(model, options);
        const Picture picture = thumbnail(result.map.map, size);
        EXPECT_EQ(picture.at(size / 2, size / 2) == thumbnail_background, layers == 2) << layers;
        EXPECT_EQ(picture.at(size / 2, 2), thumbnail_background);
    }
}

TEST(Thumbnail, FinerMapsLookTheSame) {
    FunctionMap coarse = cube(octahedral);
    FunctionMap fine = cube({Mapping::octahedral, 1025, 1025});
    EXPECT_EQ(picture_of(coarse.part()).pixels, picture_of(fine.part()).pixels);
}

TEST(Thumbnail, SizeAndPlaceOfTheObjectDoNotMatter) {
    FunctionMap map = cube(octahedral);
    const Picture here = picture_of(map.part());
    map.part().center = {1e6, -2e5, 3e5};
    map.part().radius = 1e-3;
    EXPECT_LT(differing(here, picture_of(map.part()), 8), 0.01);
    map.part().center = {};
    map.part().radius = 1e12;
    EXPECT_LT(differing(here, picture_of(map.part()), 8), 0.01);
}

TEST(Thumbnail, FrameOfThePartIsApplied) {
    FunctionMap map = sphere(octahedral, {1, 1, 1});
    map.part().frame = {{{0.1, 0, 0}, {0, 0.5, 0}, {0, 0, 0.1}}};
    const Picture picture = picture_of(map.part());
    EXPECT_NE(picture.at(size / 2, size / 16), thumbnail_background);
    EXPECT_NE(picture.at(size / 2, size * 15 / 16), thumbnail_background);
    EXPECT_EQ(picture.at(size / 8, size / 2), thumbnail_background);
    EXPECT_EQ(picture.at(size * 7 / 8, size / 2), thumbnail_background);
}

TEST(Thumbnail, NearerPartsHideFartherOnes) {
    FunctionMap red = sphere(octahedral, {1, 0, 0});
    FunctionMap green = sphere(octahedral, {0, 1, 0});
    SphericalMap map;
    map.parts = {red.part(), green.part()};
    map.parts[0].center = {-2, 0, 0};
    map.parts[1].center = {2, 0, 0};
    Picture picture = thumbnail(map, size);
    EXPECT_GT(picture.at(size / 6, size / 2)[0], picture.at(size / 6, size / 2)[1]);
    EXPECT_GT(picture.at(size * 5 / 6, size / 2)[1], picture.at(size * 5 / 6, size / 2)[0]);

    map.parts[0].center = {0, 0, 1};
    map.parts[1].center = {0, 0, -1};
    EXPECT_GT(thumbnail(map, size).at(size / 2, size / 2)[0], 150);
    std::swap(map.parts[0].center, map.parts[1].center);
    EXPECT_GT(thumbnail(map, size).at(size / 2, size / 2)[1], 150);
}

TEST(Thumbnail, WithoutSurfaceThereIsTheBackground) {
    FunctionMap nothing(octahedral, [](Vec3d) { return 0.0; });
    EXPECT_EQ(pixels_of_object(picture_of(nothing.part())), 0U);
    EXPECT_EQ(pixels_of_object(thumbnail(SphericalMap{}, 16)), 0U);
}

} // namespace
} // namespace spa::test
