// SPDX-License-Identifier: Apache-2.0
// The parts of `spa render` that need no device.
#include "../../tools/near_names.h"
#include "../../tools/render_compare.h"
#include "../../tools/render_input.h"
#include "../../tools/render_pictures.h"

#include "../../libspa/core/element_format.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace spa::test {
namespace {

using namespace spa::tools;

TEST(NearNames, DistanceAndGuesses) {
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("boot", "boot"), 0U);
    const std::vector<std::string> names{"boots", "boot", "wall", "", "root", "boot", "soot"};
    EXPECT_EQ(did_you_mean("bot", names), "; did you mean 'boot' or 'boots' or 'root'?");
    EXPECT_EQ(did_you_mean("lamp", names), "");
}

// root - boot - (boot, lace), and another boot
Scene scene_of_boots() {
    Scene scene;
    scene.nodes = {
        {"root", no_index, {}}, {"boot", 0, {}}, {"boot", 1, {}}, {"lace", 1, {}}, {"boot", 0, {}}};
    return scene;
}

TEST(RenderInput, AllNodesOfANameAreReplacedAndNoneTwice) {
    const Scene scene = scene_of_boots();
    EXPECT_EQ(find_nodes(scene, "s.glb", "boot"), (std::vector<std::uint32_t>{1, 4}));
    EXPECT_EQ(find_nodes(scene, "s.glb", "lace"), (std::vector<std::uint32_t>{3}));
}

std::string usage_error(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        return error.what();
    }
    return {};
}

TEST(RenderInput, ANodeThatThereIsNot) {
    const Scene scene = scene_of_boots();
    EXPECT_EQ(usage_error([&] { find_nodes(scene, "s.glb", "bot"); }),
              "--map: there is no node 'bot' in s.glb; did you mean 'boot' or 'root'?");
    EXPECT_EQ(usage_error([&] { find_nodes(scene, "s.glb", "lantern"); }),
              "--map: there is no node 'lantern' in s.glb; there are root, boot, lace");
}

TEST(RenderInput, MapsBelowMapsAreRefused) {
    RenderArguments arguments;
    arguments.maps = {{"lace", "lace.spa"}, {"boot", "boot.spa"}};
    EXPECT_EQ(usage_error([&] { place_maps(scene_of_boots(), arguments); }),
              "--map: the node 'lace' lies below 'boot', which has a map too; leave one of them out");
}

TEST(RenderInput, MapsThatNoRayMeetsAreNotOpened) {
    RenderArguments arguments;
    arguments.maps = {{"lace", "there is no such file"}};
    arguments.settings.primary = arguments.settings.shadow = arguments.settings.secondary =
        render::Geometry::triangles;
    EXPECT_TRUE(place_maps(scene_of_boots(), arguments).empty());
    arguments.settings.shadow = render::Geometry::maps;
    EXPECT_THROW(place_maps(scene_of_boots(), arguments), Error);
}

TEST(RenderInput, CamerasByNameAndNumber) {
    Scene scene;
    scene.model.positions = {{0, 0, 0}, {1, 1, 1}};
    RenderArguments arguments;
    EXPECT_EQ(choose_camera(scene, arguments).name, "framing");
    arguments.camera = "0";
    EXPECT_NE(usage_error([&] { choose_camera(scene, arguments); }), "");
    scene.cameras = {{"front", {}, 1}, {"side", {}, 1}, {"0", {}, 2}};
    EXPECT_EQ(choose_camera(scene, arguments).vertical_fov, 2) << "a name comes before a number";
    arguments.camera = "1";
    EXPECT_EQ(choose_camera(scene, arguments).name, "side");
    arguments.camera.reset();
    EXPECT_EQ(choose_camera(scene, arguments).name, "front");
    arguments.camera = "fron";
    EXPECT_NE(usage_error([&] { choose_camera(scene, arguments); }).find("did you mean 'front'?"),
              std::string::npos);
}

TEST(RenderInput, TheFramingCameraSeesEverything) {
    Model model;
    model.positions = {{-3, 0, 5}, {4, 0.5F, 6}, {0, 9, 5.5F}, {2, -1, 5}};
    for (const double aspect : {0.3, 1.0, 16.0 / 9, 5.0}) {
        const Camera camera = framing_camera(model, aspect);
        EXPECT_NEAR(determinant(camera.to_world.linear), 1, 1e-12) << "a rotation";
        const Affine to_camera = inverse(camera.to_world);
        const double tan_y = std::tan(camera.vertical_fov / 2);
        double widest = 0;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const Vec3d p =
                transform_point(to_camera, {(corner & 1U) != 0 ? 4.0 : -3, (corner & 2U) != 0 ? 9.0 : -1,
                                            (corner & 4U) != 0 ? 6.0 : 5});
            ASSERT_LT(p.z, 0);
            widest =
                std::max({widest, std::abs(p.x) / (-p.z * tan_y * aspect), std::abs(p.y) / (-p.z * tan_y)});
        }
        EXPECT_LT(widest, 1);
        EXPECT_GT(widest, 0.8) << "and not from far away";
    }
}

TEST(RenderInput, TheSunComesFromAboveTheLeftShoulder) {
    const Light sun = default_sun(Camera{"", {}, 1});
    EXPECT_EQ(sun.kind, LightKind::directional);
    EXPECT_NEAR(length(sun.direction), 1, 1e-12);
    EXPECT_GT(sun.direction.x, 0); // to the right
    EXPECT_LT(sun.direction.y, 0); // down
    EXPECT_LT(sun.direction.z, 0); // the way the camera looks
    EXPECT_NEAR(sun.intensity.x, std::numbers::pi, 1e-6);
}

TEST(RenderLimits, Parse) {
    const std::vector<ImageLimit> limits =
        parse_image_limits("--fail", "relmse=0.01,indirect.psnr=40,beauty.ssim=1");
    ASSERT_EQ(limits.size(), 3U);
    EXPECT_EQ(limit_name(limits[0]), "relmse");
    EXPECT_EQ(limit_name(limits[1]), "indirect.psnr");
    EXPECT_EQ(limit_name(limits[2]), "ssim");
    for (const char* const text : {"", "relmse", "relmse=", "relmse=x", "relmse=-1", "depth.relmse=1",
                                   "mse=1", "relmse=1,", ".relmse=1", "indirect.=1"})
        EXPECT_EQ(usage_error([&] { parse_image_limits("--fail", text); }).rfind("--fail: ", 0), 0U) << text;
}

TEST(RenderLimits, SmallErrorsAndLargeSimilaritiesAreMet) {
    measure::ImageErrors errors;
    errors.rel_mse = 0.01;
    errors.psnr = 40;
    const auto is_met = [&](const char* text) { return met(parse_image_limits("", text).front(), errors); };
    EXPECT_TRUE(is_met("relmse=0.01"));
    EXPECT_FALSE(is_met("relmse=0.009"));
    EXPECT_TRUE(is_met("psnr=40"));
    EXPECT_FALSE(is_met("psnr=40.1"));
    EXPECT_FALSE(is_met("ssim=0")) << "what cannot be formed meets nothing";
    errors.psnr = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(is_met("psnr=1000"));
}

render::Frame small_frame() {
    render::Frame frame;
    frame.width = 2;
    frame.height = 2;
    frame.direct = {{0.5F, 1, 2}, {0, 0, 0}, {0.1F, 0.1F, 0.1F}, {0, 0, 0}};
    frame.indirect = {{0.25F, 0, 0}, {0, 0, 0}, {0.1F, 0.2F, 0.3F}, {0, 0, 0}};
    frame.normal = {{0, 0, 1}, {0, 0, 0}, {-1, 0, 0}, {0, 0, 0}};
    frame.albedo = {{0.8F, 0.7F, 0.6F}, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}};
    const float far = std::numeric_limits<float>::infinity();
    frame.depth = {1, far, 3, far};
    frame.kind = {1, 0, 4, 0};
    return frame;
}

TEST(RenderPictures, AnExrHasTheLayersOfTheFrame) {
    const render::Frame frame = small_frame();
    std::vector<std::byte> bytes = encode_frame(frame);
    EXPECT_EQ(bytes, encode_frame(frame));
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto input = OIIO::ImageInput::open("memory.exr", nullptr, &memory);
    ASSERT_TRUE(input) << OIIO::geterror();
    const OIIO::ImageSpec spec = input->spec();
    EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
    EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
    EXPECT_EQ(spec.find_attribute("DateTime"), nullptr);
    EXPECT_EQ(spec.nchannels, 17);
    std::vector<float> values(std::size_t(4) * 17);
    ASSERT_TRUE(input->read_image(0, 0, 0, 17, OIIO::TypeDesc::FLOAT, values.data()));
    const auto value = [&](const char* channel, std::size_t pixel) {
        const int index = spec.channelindex(channel);
        EXPECT_GE(index, 0) << channel;
        return values[pixel * 17 + std::size_t(std::max(index, 0))];
    };
    EXPECT_EQ(value("R", 0), 0.75F);
    EXPECT_EQ(value("B", 0), 2);
    EXPECT_EQ(value("direct.G", 0), 1);
    EXPECT_EQ(value("indirect.B", 2), 0.3F);
    EXPECT_EQ(value("normal.Z", 0), 1);
    EXPECT_EQ(value("normal.X", 2), -1);
    EXPECT_EQ(value("albedo.R", 0), 0.8F);
    EXPECT_EQ(value("depth.Z", 2), 3);
    EXPECT_TRUE(std::isinf(value("depth.Z", 1)));
    EXPECT_EQ(value("kind", 2), 4);
}

TEST(RenderPictures, ToneMapping) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Vec3f> light{{0.25F, 0.5F, 7}, {-1, nan, 0}};
    const Picture picture = tone_map(2, 1, light, 1);
    EXPECT_EQ(picture.at(0, 0), (Rgb{linear_to_srgb(0.5F), 255, 255}));
    EXPECT_EQ(picture.at(1, 0), (Rgb{0, 0, 0}));
    EXPECT_EQ(tone_map(2, 1, light, -2).at(0, 0)[1], linear_to_srgb(0.125F));
}

TEST(RenderPictures, WhatNoRayMetIsBlack) {
    for (const NamedPicture& aov : aov_pictures(small_frame(), 0)) {
        EXPECT_EQ(aov.picture.at(1, 0), (Rgb{0, 0, 0})) << aov.name;
        EXPECT_NE(aov.picture.at(0, 0), (Rgb{0, 0, 0})) << aov.name;
        EXPECT_NE(aov.picture.at(0, 1), aov.picture.at(0, 0)) << aov.name;
    }
    EXPECT_EQ(beside("a/out.png", "depth"), "a/out.depth.png");
}

TEST(RenderCompare, LayersThatTheReferenceHas) {
    const render::Frame frame = small_frame();
    spa::import::LinearPicture reference{2, 2, {{"", beauty(frame)}, {"indirect", frame.direct}}};
    const ImageComparison comparison =
        compare_with(frame, reference, "ref.exr", 0, parse_image_limits("", "relmse=0,indirect.relmse=0.1"));
    ASSERT_EQ(comparison.layers.size(), 2U);
    EXPECT_EQ(comparison.layers[0].errors.rel_mse, 0);
    EXPECT_GT(comparison.layers[1].errors.rel_mse, 0.1);
    ASSERT_EQ(comparison.missed().size(), 1U);
    EXPECT_EQ(limit_sentence(comparison, comparison.missed().front()).rfind("indirect.relmse is ", 0), 0U);
    EXPECT_TRUE(comparison_json(comparison, "ref.exr")["figures"]["beauty"]["psnr"].is_null());
    const Picture sheet = comparison_sheet(comparison, "title");
    EXPECT_GT(sheet.height, 100U);
    reference.layers[1].pixels[0].x = std::numeric_limits<float>::quiet_NaN();
    try {
        static_cast<void>(compare_with(frame, reference, "ref.exr", 0, {}));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data);
        EXPECT_NE(std::string(error.what()).find("ref.exr: indirect: the reference has 1 pixel"),
                  std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace spa::test
