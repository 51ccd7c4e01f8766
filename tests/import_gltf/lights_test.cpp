// SPDX-License-Identifier: Apache-2.0
// read_scene: the lights of KHR_lights_punctual.
#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Lights, PointLightWithColourAndIntensity) {
    GltfBuilder builder =
        lit_triangle({{"type", "point"}, {"name", "bulb"}, {"color", {1, 0.5, 0.25}}, {"intensity", 8}});
    builder.json["nodes"][1]["translation"] = {1, 2, 3};
    const SceneResult result = read_scene_both(builder);
    ASSERT_EQ(result.scene.lights.size(), 1U);
    const Light& light = result.scene.lights[0];
    EXPECT_EQ(light.name, "bulb");
    EXPECT_EQ(light.kind, LightKind::point);
    EXPECT_EQ(light.position, (Vec3d{1, 2, 3}));
    EXPECT_EQ(light.intensity, (Vec3f{8, 4, 2}));
}

TEST(Lights, Defaults) {
    const Light point = read_scene_both(lit_triangle({{"type", "point"}})).scene.lights.at(0);
    EXPECT_EQ(point.name, "lamp") << "the name of the node";
    EXPECT_EQ(point.intensity, (Vec3f{1, 1, 1}));
    for (const Json& spot : {Json::object(), Json(nullptr)}) {
        Json source{{"type", "spot"}};
        if (spot.is_object()) source["spot"] = spot;
        const Light light = read_scene_both(lit_triangle(source)).scene.lights.at(0);
        EXPECT_EQ(light.kind, LightKind::spot);
        EXPECT_EQ(light.direction, (Vec3d{0, 0, -1}));
        EXPECT_EQ(light.inner_cone, 0);
        EXPECT_DOUBLE_EQ(light.outer_cone, pi / 4);
    }
}

// Found by fuzzing: elements of the empty array were read.
TEST(Lights, AnEmptyColourIsAsGoodAsNone) {
    const SceneResult result = read_scene_both(lit_triangle({{"type", "point"}, {"color", Json::array()}}));
    EXPECT_EQ(result.scene.lights.at(0).intensity, (Vec3f{1, 1, 1}));
    const std::vector<std::string>& warnings = result.report.warnings;
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
        return warning.find("lights[0].color: is an empty array") != std::string::npos;
    }));
}

TEST(Lights, DirectionsTurnWithTheirNodesAndStayUnit) {
    for (const char* type : {"directional", "spot"}) {
        GltfBuilder builder = lit_triangle({{"type", type}});
        // A quarter turn about x takes -z to +y; the parent stretches that and turns it to -x.
        builder.json["nodes"][1]["rotation"] = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
        builder.json["nodes"].push_back({{"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}},
                                         {"scale", {3, 7, 5}},
                                         {"translation", {0, 1, 0}},
                                         {"children", {1}}});
        builder.json["scenes"][0]["nodes"] = {0, 2};
        const Light light = read_scene_both(builder).scene.lights.at(0);
        expect_near(to_float(light.direction), {-1, 0, 0});
        expect_near(to_float(light.position), {0, 1, 0});
        EXPECT_EQ(light.intensity, (Vec3f{1, 1, 1})) << "scales do not change it";
    }
}

TEST(Lights, OneSourceAtTwoNodes) {
    GltfBuilder builder = lit_triangle({{"type", "point"}});
    builder.json["nodes"].push_back(builder.json["nodes"][1]);
    builder.json["nodes"][2]["translation"] = {0, 9, 0};
    builder.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = read_scene_both(builder).scene;
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.lights[1].position, (Vec3d{0, 9, 0}));
}

TEST(Lights, MayBeRequired) {
    GltfBuilder builder = lit_triangle({{"type", "point"}});
    builder.json["extensionsRequired"] = {"KHR_lights_punctual"};
    EXPECT_EQ(read_scene_both(builder).scene.lights.size(), 1U);
}

TEST(Lights, RangeIsWarnedOf) {
    const SceneResult result = read_scene_both(lit_triangle({{"type", "point"}, {"range", 2}}));
    EXPECT_TRUE(has_warning(result.report, "KHR_lights_punctual.lights[0].range: is ignored"));
}

TEST(Lights, HalfOfPiInSinglePrecisionIsTaken) {
    const double angle = double(std::numbers::pi_v<float> / 2);
    ASSERT_GT(angle, pi / 2);
    const Light light =
        read_scene_both(lit_triangle({{"type", "spot"}, {"spot", {{"outerConeAngle", angle}}}}))
            .scene.lights.at(0);
    EXPECT_EQ(light.outer_cone, pi / 2);
}

struct Defect {
    const char* name;
    Json light;
    const char* message;
};

TEST(Lights, DefectsAreNamed) {
    const auto spot = [](const Json& cones) { return Json{{"type", "spot"}, {"spot", cones}}; };
    const Defect defects[] = {
        {"no type", Json::object(), "lights[0].type: is missing"},
        {"unknown type", {{"type", "area"}}, "lights[0].type: is 'area' instead of one of"},
        {"type of another type", {{"type", 1}}, "lights[0].type: must be of type string"},
        {"intensity", {{"type", "point"}, {"intensity", "1"}}, "intensity: must be of type number"},
        {"negative", {{"type", "point"}, {"intensity", -1}}, "lights[0].intensity: is negative"},
        {"not a number", {{"type", "point"}, {"intensity", nullptr}}, "intensity: must be of type number"},
        {"too large", {{"type", "point"}, {"intensity", 1e39}}, "intensity: is too large for a float"},
        {"short colour", {{"type", "point"}, {"color", {1, 1}}}, "color: has 2 elements instead of 3"},
        {"negative colour", {{"type", "point"}, {"color", {0, -0.1, 0}}}, "color: is negative"},
        {"colour type", {{"type", "point"}, {"color", {1, 1, "1"}}}, "color[2]: must be of type number"},
        {"spot type", {{"type", "spot"}, {"spot", 5}}, "spot: must be of type object"},
        {"cone type", spot({{"outerConeAngle", true}}), "outerConeAngle: must be of type number"},
        {"inner negative", spot({{"innerConeAngle", -0.1}}), "0 <= innerConeAngle < outerConeAngle"},
        {"inner is outer", spot({{"innerConeAngle", 0.3}, {"outerConeAngle", 0.3}}), "0 <= innerConeAngle"},
        {"inner beyond the default", spot({{"innerConeAngle", 0.8}}), "0 <= innerConeAngle"},
        {"outer too wide", spot({{"outerConeAngle", 1.58}}), "outerConeAngle <= pi/2"},
        {"name", {{"type", "point"}, {"name", 3}}, "lights[0].name: must be of type string"},
    };
    for (const Defect& defect : defects) {
        SCOPED_TRACE(defect.name);
        const GltfBuilder builder = lit_triangle(defect.light);
        const std::string message = scene_refusal(builder);
        EXPECT_NE(message.find(defect.message), std::string::npos) << message;
        EXPECT_NE(message.find("extensions.KHR_lights_punctual.lights[0]"), std::string::npos) << message;
        EXPECT_EQ(refusal(builder), "imported") << "a model needs no lights";
    }
}

TEST(Lights, ReferencesAreChecked) {
    const auto refused = [](const Json& of_node) {
        GltfBuilder builder = lit_triangle({{"type", "point"}});
        builder.json["nodes"][1]["extensions"]["KHR_lights_punctual"] = of_node;
        return scene_refusal(builder);
    };
    const std::string where = "nodes[1].extensions.KHR_lights_punctual";
    EXPECT_NE(refused({{"light", 1}}).find(where + ".light: 1 is out of range (the document has 1 lights)"),
              std::string::npos);
    EXPECT_NE(refused({{"light", -1}}).find(where + ".light: -1 is out of range"), std::string::npos);
    EXPECT_NE(refused({{"light", "0"}}).find(where + ".light: must be of type integer"), std::string::npos);
    EXPECT_NE(refused(Json::object()).find(where + ".light: is missing"), std::string::npos);
    EXPECT_NE(refused(7).find(where + ": must be of type object"), std::string::npos);

    GltfBuilder builder = lit_triangle({{"type", "point"}});
    builder.json.erase("extensions");
    EXPECT_NE(scene_refusal(builder).find("0 is out of range (the document has 0 lights)"),
              std::string::npos);
    builder.json["extensions"]["KHR_lights_punctual"] = {{"lights", 3}};
    EXPECT_NE(scene_refusal(builder).find("lights: must be an array"), std::string::npos);
}

TEST(Lights, ADirectionIsNeeded) {
    GltfBuilder builder = lit_triangle({{"type", "spot"}});
    builder.json["nodes"][1]["scale"] = {1, 1, 0};
    EXPECT_NE(scene_refusal(builder).find("nodes[1]: has a light, but its transform leaves no direction"),
              std::string::npos);
    builder.json["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "point";
    EXPECT_EQ(scene_refusal(builder), "read");
}

TEST(Lights, TheShareOfASpotFallsFromConeToCone) {
    Light light;
    light.inner_cone = 0.2;
    light.outer_cone = 0.5;
    EXPECT_EQ(spot_share(light, 1), 1);
    EXPECT_EQ(spot_share(light, std::cos(0.2)), 1);
    EXPECT_EQ(spot_share(light, std::cos(0.5)), 0);
    EXPECT_EQ(spot_share(light, -1), 0);
    EXPECT_NEAR(spot_share(light, (std::cos(0.2) + std::cos(0.5)) / 2), 0.25, 1e-12);
    light.inner_cone = 0;
    light.outer_cone = 1e-12; // cosines that are equal
    EXPECT_EQ(spot_share(light, 1), 1);
    EXPECT_EQ(spot_share(light, 0.999), 0);
}

} // namespace
} // namespace spa::test
