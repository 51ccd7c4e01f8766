// SPDX-License-Identifier: Apache-2.0
// Animations: what is read, how it is interpolated, and what is refused.
#include "scene_builder.h"

#include "../../libspa/core/error.h"
#include "../../libspa/mesh/pose.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using Floats = std::vector<float>;

SceneResult read_rig(const GltfBuilder& builder) {
    const Scratch scratch;
    return import::read_scene(scratch.write("a.glb", builder.glb()), {}, {.rig = true});
}

std::string rig_refusal(const GltfBuilder& builder) {
    try {
        (void)read_rig(builder);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data);
        return error.what();
    }
    return "read";
}

// The triangle of node 0, moved by one channel.
GltfBuilder moved(const char* path, const Floats& times, const Floats& values, const char* mode = "LINEAR") {
    GltfBuilder builder = triangle();
    const bool turns = std::string_view(path) == "rotation";
    const int input = builder.add_accessor<float>(times, "SCALAR");
    const int output = builder.add_accessor<float>(values, turns ? "VEC4" : "VEC3");
    builder.json["animations"] = Json::array(
        {{{"name", "move"},
          {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}})},
          {"samplers", Json::array({{{"input", input}, {"output", output}, {"interpolation", mode}}})}}});
    return builder;
}

Affine place_at(const Scene& scene, double time) {
    return pose_nodes(scene, scene.rig.animations.at(0), time).at(0);
}

void expect_near(const Affine& a, const Affine& b) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(length(a.linear.row[i] - b.linear.row[i]), 1e-6) << i;
    EXPECT_LT(length(a.translation - b.translation), 1e-6);
}

Affine turned_by(double degrees) { // about z
    const double c = std::cos(degrees * std::numbers::pi / 180),
                 s = std::sin(degrees * std::numbers::pi / 180);
    return {{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}, {}};
}

TEST(Animation, LinearTranslation) {
    const Scene scene = read_rig(moved("translation", {1, 3}, {0, 0, 0, 4, 8, 0})).scene;
    ASSERT_EQ(scene.rig.animations.size(), 1U);
    EXPECT_EQ(scene.rig.animations[0].name, "move");
    EXPECT_EQ(scene.rig.animations[0].seconds, 3);
    expect_near(place_at(scene, 1.5), {{}, {1, 2, 0}});
    expect_near(place_at(scene, 0), {});
    expect_near(place_at(scene, std::nan("")), {});
    expect_near(place_at(scene, 3), {{}, {4, 8, 0}});
    expect_near(place_at(scene, 1e9), {{}, {4, 8, 0}});
}

TEST(Animation, StepKeepsTheKeyBefore) {
    const Scene scene = read_rig(moved("scale", {1, 3}, {2, 2, 2, 5, 5, 5}, "STEP")).scene;
    const auto scaled = [](double s) { return Affine{{{{s, 0, 0}, {0, s, 0}, {0, 0, s}}}, {}}; };
    expect_near(place_at(scene, 2.999), scaled(2));
    expect_near(place_at(scene, 3), scaled(5));
}

// At constant speed, the shorter way round: the second key has the sign that points the long way.
TEST(Animation, LinearRotation) {
    const auto half = float(std::sqrt(0.5));
    const Scene scene = read_rig(moved("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, -half, -half})).scene;
    for (const double t : {0.0, 0.25, 0.5, 0.9, 1.0}) expect_near(place_at(scene, t), turned_by(90 * t));
}

TEST(Animation, RotationOfNormalizedIntegers) {
    GltfBuilder builder = moved("rotation", {0}, {0, 0, 0, 1});
    builder.json["animations"][0]["samplers"][0]["output"] =
        builder.add_accessor<std::int16_t>({0, 0, 32767, 0}, "VEC4", true);
    expect_near(place_at(read_rig(builder).scene, 0), turned_by(180));
    builder.json["accessors"].back()["normalized"] = false;
    EXPECT_NE(rig_refusal(builder).find("animations[0].samplers[0].output: is not a VEC4 of floats"),
              std::string::npos);
}

// glTF 2.0, appendix C.5: the Hermite polynomial with the tangents times the time between the keys.
TEST(Animation, CubicSpline) {
    const Floats values = {9, 9, 9, 1, 0, 0, 0.5F, 2, 0, /* next key */ -1, 0, 3, 4, 1, 0, 9, 9, 9};
    const Scene scene = read_rig(moved("translation", {2, 6}, values, "CUBICSPLINE")).scene;
    const Vec3d v0{1, 0, 0}, b0{0.5, 2, 0}, a1{-1, 0, 3}, v1{4, 1, 0};
    for (const double t : {0.0, 0.3, 0.5, 0.8, 1.0}) {
        // By de Casteljau's construction over the same curve's Bezier points.
        Vec3d p[4] = {v0, v0 + b0 * (4.0 / 3), v1 - a1 * (4.0 / 3), v1};
        for (int level = 3; level > 0; --level)
            for (int i = 0; i < level; ++i) p[i] = p[i] * (1 - t) + p[i + 1] * t;
        expect_near(place_at(scene, 2 + 4 * t), {{}, p[0]});
    }
}

// What has no channel rests, and children follow.
TEST(Animation, ChildrenFollowAndTheRestRests) {
    GltfBuilder builder = moved("translation", {0, 1}, {0, 0, 0, 0, 0, 8});
    builder.json["nodes"] = {{{"children", {1}}, {"scale", {2, 2, 2}}},
                             {{"mesh", 0}, {"translation", {1, 0, 0}}}};
    const Scene scene = read_rig(builder).scene;
    const std::vector<Affine> to_world = pose_nodes(scene, scene.rig.animations[0], 0.5);
    const Mat3 twice{{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
    expect_near(to_world[0], {twice, {0, 0, 4}});
    expect_near(to_world[1], {twice, {2, 0, 4}});
    Model model = scene.model;
    pose_vertices(scene, to_world, model);
    test::expect_near(model.positions[1], {4, 0, 4});
    test::expect_near(model.normals[1], {0, 0, 1});
}

TEST(Animation, MovesANodeWhereverItStands) {
    GltfBuilder builder = moved("translation", {0}, {0, 1, 0});
    builder.json["nodes"] = {{{"mesh", 0}},
                             {{"children", {0}}, {"translation", {1, 0, 0}}},
                             {{"children", {0}}, {"translation", {2, 0, 0}}}};
    builder.json["scenes"][0]["nodes"] = {1, 2};
    const Scene scene = read_rig(builder).scene;
    const std::vector<Affine> to_world = pose_nodes(scene, scene.rig.animations[0], 0);
    expect_near(to_world[1], {{}, {1, 1, 0}});
    expect_near(to_world[3], {{}, {2, 1, 0}});
}

// Parts of a map follow nodes by their number in the file.
TEST(Animation, PartsFollowNodes) {
    GltfBuilder builder = moved("translation", {0}, {0, 1, 0});
    builder.json["nodes"] = {{{"mesh", 0}},
                             {{"children", {0}}, {"translation", {1, 0, 0}}},
                             {{"children", {0}}, {"translation", {2, 0, 0}}}};
    builder.json["scenes"][0]["nodes"] = {1, 2};
    const Scene scene = read_rig(builder).scene;
    const std::vector<Affine> to_world = pose_nodes(scene, scene.rig.animations[0], 0);
    SphericalMap map;
    map.parts.resize(2);
    map.parts[1].node = 0;
    map.parts[1].to_node = {{}, {0, 0, 5}};
    const Affine otherwise{{}, {7, 7, 7}};
    const auto parts_below = [&](std::uint32_t node) {
        return pose_parts(scene, to_world, map, node, otherwise);
    };
    expect_near(parts_below(no_index).at(0), otherwise);
    expect_near(parts_below(no_index).at(1), {{}, {1, 1, 5}}); // the first of those of number 0
    expect_near(parts_below(2).at(1), {{}, {2, 1, 5}});        // the one below
    expect_near(parts_below(0).at(1), {{}, {1, 1, 5}});
    map.parts[1].node = 3;
    EXPECT_THROW((void)parts_below(no_index), Error);
}

TEST(Animation, WhatIsLeftOut) {
    GltfBuilder builder = moved("weights", {0}, {1, 1, 1});
    SceneResult result = read_rig(builder);
    EXPECT_TRUE(has_warning(result.report, "animations[0].channels[0]: moves the weights of morph targets"));
    EXPECT_TRUE(result.scene.rig.animations.at(0).tracks.empty());
    builder.json["animations"][0]["channels"][0]["target"] = {{"path", "pointer"}};
    EXPECT_TRUE(has_warning(read_rig(builder).report, "does not move a node and is left out"));
    builder = moved("translation", {0}, {1, 1, 1});
    builder.json["nodes"].push_back({{"name", "not in the scene"}});
    builder.json["animations"][0]["channels"][0]["target"]["node"] = 1;
    result = read_rig(builder);
    EXPECT_TRUE(result.scene.rig.animations.at(0).tracks.empty());
    EXPECT_TRUE(result.report.warnings.empty());
}

TEST(Animation, MalformedIsRefused) {
    const auto refused = [](const GltfBuilder& builder, const std::string& message) {
        const std::string said = rig_refusal(builder);
        EXPECT_NE(said.find("animations[0]." + message), std::string::npos) << said;
        EXPECT_NO_THROW((void)read_scene_both(builder)); // without a rig nobody needs it
    };
    const Floats two = {0, 0, 0, 1, 1, 1};
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    const std::string grow =
        "samplers[0].input: has a time at position 1 that is not finite or does not grow";
    refused(moved("translation", {1, 1}, two), grow);
    refused(moved("translation", {1, 0}, two), grow);
    refused(moved("translation", {1, nan}, two), grow);
    refused(moved("translation", {1, infinity}, two), grow);
    refused(moved("translation", {0, 1}, {0, 0, 0, 1, nan, 1}),
            "samplers[0].output: has a value at position 1 that is not finite");
    refused(moved("translation", {0, 1, 2}, two), "samplers[0].output: has 2 elements for 3 times");
    refused(moved("translation", {0, 1}, two, "CUBICSPLINE"),
            "samplers[0].output: has 2 elements for 2 times, of which each wants 3");
    GltfBuilder builder = moved("translation", {0, 1}, two);
    builder.json["animations"][0]["channels"].push_back(builder.json["animations"][0]["channels"][0]);
    refused(builder, "channels[1]: moves what a channel before it moves");
    builder = moved("translation", {0, 1}, two);
    builder.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
    refused(builder, "samplers[0].output: is not a VEC4 of floats or normalized integers");
    builder = moved("translation", {0, 1}, two);
    builder.json["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    refused(builder, "channels[0]: nodes[0] has a matrix");
    builder = moved("translation", {0, 1}, two);
    builder.json["animations"][0]["samplers"][0]["input"] = 0; // positions
    refused(builder, "samplers[0].input: is not a SCALAR of floats");
}

// A few bytes may claim accessors without data of any length, and again and again.
TEST(Animation, HugeCurvesAreRefused) {
    GltfBuilder builder = moved("translation", {0, 1}, {0, 0, 0, 1, 1, 1});
    for (const int accessor : {2, 3}) {
        Json& claim = builder.json["accessors"][std::size_t(accessor)];
        claim.erase("bufferView");
        claim["count"] = std::uint64_t{1} << 40U;
    }
    EXPECT_NE(rig_refusal(builder).find("animations[0].samplers[0]: has more keys than the limit"),
              std::string::npos);
}

} // namespace
} // namespace spa::test
