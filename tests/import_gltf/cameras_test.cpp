// SPDX-License-Identifier: Apache-2.0
// read_scene: cameras.
#include "scene_builder.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

TEST(Cameras, StandWhereTheirNodeStands) {
    GltfBuilder builder = seen_triangle({{"yfov", 0.7}, {"znear", 0.1}, {"aspectRatio", 1.5}});
    builder.json["nodes"][1]["translation"] = {1, 2, 3};
    const Scene scene = read_scene_both(builder).scene;
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].name, "view") << "the name of the node";
    EXPECT_EQ(scene.cameras[0].to_world, (Affine{{}, {1, 2, 3}}));
    EXPECT_EQ(scene.cameras[0].vertical_fov, 0.7);
    builder.json["cameras"][0]["name"] = "close";
    EXPECT_EQ(read_scene_both(builder).scene.cameras.at(0).name, "close");
}

TEST(Cameras, OrthographicOnesAreLeftOut) {
    GltfBuilder builder = seen_triangle({{"yfov", 0.7}, {"znear", 0.1}});
    builder.json["cameras"].push_back(
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}});
    builder.json["nodes"].push_back({{"camera", 1}});
    builder.json["scenes"][0]["nodes"].push_back(2);
    const SceneResult result = read_scene_both(builder);
    EXPECT_EQ(result.scene.cameras.size(), 1U);
    EXPECT_EQ(result.scene.nodes.size(), 3U);
    EXPECT_TRUE(has_warning(result.report, "cameras[1]: is orthographic, which is not read"));
}

TEST(Cameras, DefectsAreNamed) {
    struct Defect {
        Json perspective;
        const char* message;
    };
    const Defect defects[] = {
        {Json::object(), "cameras[0].perspective.yfov: is missing"},
        {{{"yfov", 0}}, "yfov: is 0 instead of between 0 and pi"},
        {{{"yfov", -1}}, "yfov: is -1 instead of"},
        {{{"yfov", 3.15}}, "yfov: is 3.15 instead of"},
        {{{"yfov", "1"}}, "yfov: must be of type number"},
        {{{"yfov", nullptr}}, "yfov: must be of type number"},
        {{{"yfov", 1}, {"aspectRatio", "1"}}, "aspectRatio: must be of type number"},
        {5, "cameras[0].perspective: must be of type object"},
    };
    for (const Defect& defect : defects) {
        const GltfBuilder builder = seen_triangle(defect.perspective);
        const std::string message = scene_refusal(builder);
        EXPECT_NE(message.find(defect.message), std::string::npos) << message;
        if (!defect.perspective.is_object()) continue;
        EXPECT_EQ(refusal(builder), "imported") << "a model needs no cameras";
    }
    GltfBuilder builder = seen_triangle({{"yfov", 1}});
    builder.json["cameras"][0].erase("perspective");
    EXPECT_NE(scene_refusal(builder).find("cameras[0].perspective: is missing"), std::string::npos);
    builder.json["cameras"][0]["type"] = "fisheye";
    EXPECT_NE(scene_refusal(builder).find("cameras[0].type: is 'fisheye' instead of"), std::string::npos);
    builder = seen_triangle({{"yfov", 1}});
    builder.json["nodes"][1]["camera"] = 1;
    EXPECT_NE(scene_refusal(builder).find("nodes[1].camera: 1 is out of range"), std::string::npos);
}

TEST(Cameras, AFlatOneIsRefused) {
    GltfBuilder builder = seen_triangle({{"yfov", 1}});
    builder.json["nodes"][1]["scale"] = {1, 0, 1};
    EXPECT_NE(scene_refusal(builder).find("nodes[1]: has a camera, but its transform leaves no volume"),
              std::string::npos);
}

} // namespace
} // namespace spa::test
