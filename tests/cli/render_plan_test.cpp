// SPDX-License-Identifier: Apache-2.0
// `spa render --plan` from end to end, on software Vulkan.
#include "process.h"
#include "schema.h"
#include "vulkan_test.h"

#include "../../formats/import/linear_picture.h"
#include "../../samples/scenes.h"
#include "../support/object_plan.h"
#include "../support/object_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spa::test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using Arguments = std::vector<std::string>;

class RenderPlan : public VulkanVerbTest {
protected:
    void SetUp() override {
        VulkanVerbTest::SetUp();
        if (IsSkipped()) return;
        samples::write_glb(object_scene(), path("scene.glb"));
        plan_ = object_plan(ordered_json::array());
        write_plan();
    }
    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    void write_plan() const { write_file(path("plan.json"), plan_.dump()); }
    void batch() const {
        const Outcome outcome = run_spa({"batch", "--from-plan", "plan.json", "-q"}, folder_.path());
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    [[nodiscard]] Outcome render(const std::string& output, const Arguments& more = {}) const {
        Arguments arguments{"render", "-o", output, "-q", "--size", "48x32"};
        if (std::find(more.begin(), more.end(), "--samples") == more.end())
            arguments.insert(arguments.end(), {"--samples", "8"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_spa(arguments, folder_.path());
    }
    [[nodiscard]] json report(const std::string& output, Arguments more = {}) const {
        more.insert(more.end(), {"--plan", "plan.json", "--format", "json"});
        const Outcome outcome = render(output, more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        json report = json::parse(outcome.out, nullptr, false);
        EXPECT_EQ(schema_error(load_schema("render"), report), "") << outcome.out;
        return report;
    }

    TemporaryFolder folder_;
    ordered_json plan_;
};

TEST_F(RenderPlan, SetsThreeWaysBesideEachOther) {
    batch();
    ASSERT_EQ(render("reference.exr", {"scene.glb", "--samples", "32"}).exit_code, 0);
    const json report = this->report("plan.exr", {"--compare", "reference.exr", "--plan-sheet", "sheet.png"});
    EXPECT_EQ(report["files"][1]["path"], "sheet.png");
    const json& plan = report["plan"];
    EXPECT_EQ(plan["objects"], (json{{"map", 3}, {"triangles", 1}, {"drop", 1}}));
    EXPECT_EQ(plan["not_baked"], json::array());
    const json& triangles = plan["variants"]["triangles"];
    const json& one_size = plan["variants"]["one_size"];
    const json& planned = plan["variants"]["plan"];
    EXPECT_EQ(triangles["maps"], 0);
    EXPECT_EQ(one_size["maps"], 3) << "floor, ball with its twin, stand";
    EXPECT_EQ(planned["maps"], 2);
    EXPECT_TRUE(triangles["indirect"].is_null());
    for (const json* variant : {&one_size, &planned}) {
        EXPECT_GT((*variant)["indirect"]["relmse"], 0);
        EXPECT_LT((*variant)["indirect"]["relmse"], 0.05);
    }
    for (const json* variant : {&triangles, &one_size, &planned}) {
        EXPECT_GT((*variant)["indirect_to_reference"]["relmse"], 0);
        EXPECT_GT((*variant)["frame_seconds"], 0);
        const json& memory = (*variant)["memory"];
        EXPECT_LE(memory["by_map_rays"], memory["resident"]);
    }
    EXPECT_EQ(triangles["memory"]["by_map_rays"], triangles["memory"]["resident"]);
    EXPECT_EQ(planned["file_bytes"], std::filesystem::file_size(path("maps/ball.spa")) +
                                         std::filesystem::file_size(path("maps/stand.spa")));
    EXPECT_GT(one_size["file_bytes"], planned["file_bytes"]) << "64 cells a side instead of 32";
    const json scene = report["scene"];
    EXPECT_EQ(plan["unique_triangles"].get<int>(),
              scene["triangles"].get<int>() - (scene["replaced_triangles"].get<int>() - 12) / 2)
        << "the twin is the ball once more; the stand has 12 triangles";
    // The figures are of the same pictures as when they are made one by one.
    ASSERT_EQ(render("triangles.exr", {"scene.glb"}).exit_code, 0);
    const json alone = this->report("again.exr", {"--compare", "triangles.exr", "--plan-only"});
    EXPECT_EQ(alone["comparison"]["figures"]["indirect"], planned["indirect"]);
    EXPECT_TRUE(alone["plan"]["variants"]["triangles"].is_null());
    EXPECT_EQ(read_file(path("again.exr")), read_file(path("plan.exr")));
}

// The two say the same: a plan, and the maps that it decided on, one by one.
TEST_F(RenderPlan, IsWhatMapsByHandAre) {
    plan_["objects"].erase(4); // the crumb, which no --map can drop
    write_plan();
    batch();
    ASSERT_EQ(render("plan.exr", {"--plan", "plan.json", "--plan-only"}).exit_code, 0);
    ASSERT_EQ(render("hand.exr", {"scene.glb", "--map", "ball=maps/ball.spa", "--map", "twin=maps/ball.spa",
                                  "--map", "stand=maps/stand.spa"})
                  .exit_code,
              0);
    EXPECT_EQ(read_file(path("plan.exr")), read_file(path("hand.exr")));
}

TEST_F(RenderPlan, InstancesShareOneMapOnTheDevice) {
    batch();
    const json shared = report("shared.exr", {"--plan-only"});
    plan_["objects"][2]["decision"] = "triangles";
    write_plan();
    const json single = report("single.exr", {"--plan-only"});
    EXPECT_EQ(shared["memory"]["maps"], single["memory"]["maps"]);
    EXPECT_EQ(shared["memory"]["map_structures"], single["memory"]["map_structures"]);
    EXPECT_GT(shared["memory"]["top_level"], single["memory"]["top_level"]);
}

std::size_t hits(const std::filesystem::path& picture) {
    const import::LinearPicture read = import::read_picture(picture);
    const std::vector<Vec3f>& pixels = read.layers[0].pixels;
    return std::size_t(
        std::count_if(pixels.begin(), pixels.end(), [](Vec3f pixel) { return pixel != Vec3f{}; }));
}

// All dropped: the camera sees it as long as its rays meet triangles.
TEST_F(RenderPlan, WhatIsDroppedIsThereForTrianglesOnly) {
    for (auto& object : plan_["objects"]) object["decision"] = "drop";
    write_plan();
    const json report = this->report("seen.exr", {"--plan-only"});
    EXPECT_EQ(report["plan"]["dropped_triangles"], report["scene"]["triangles"]);
    EXPECT_EQ(report["settings"]["samples"], 8) << "as given; else those of the plan";
    EXPECT_EQ(report["plan"]["variants"]["plan"]["memory"]["by_map_rays"], report["memory"]["top_level"]);
    EXPECT_GT(hits(path("seen.exr")), 200U);
    static_cast<void>(this->report("gone.exr", {"--plan-only", "--primary", "maps"}));
    EXPECT_EQ(hits(path("gone.exr")), 0U);
    const auto seen = import::read_picture(path("seen.exr"), std::vector<std::string_view>{"indirect"});
    for (const Vec3f pixel : seen.find("indirect")->pixels)
        EXPECT_EQ(pixel, Vec3f{}) << "secondary rays meet nothing";
}

TEST_F(RenderPlan, WhatIsMissingOrOfAnotherScene) {
    const Outcome missing = render("out.png", {"--plan", "plan.json"});
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_NE(missing.err.find("ball.spa: the map of node 1 'ball' is not there; run spa batch --from-plan"),
              std::string::npos)
        << missing.err;
    batch();
    std::filesystem::copy_file(path("maps/stand.spa"), path("maps/ball.spa"),
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_NE(render("out.png", {"--plan", "plan.json"}).err.find("was baked from node 3"),
              std::string::npos);
    plan_["objects"][1]["name"] = "bell";
    write_plan();
    const Outcome other = render("out.png", {"--plan", "plan.json"});
    EXPECT_EQ(other.exit_code, 3);
    EXPECT_NE(other.err.find("plan.json: /objects/1 is node 1 'bell', and scene.glb has node 1 'ball'"),
              std::string::npos)
        << other.err;
    EXPECT_EQ(render("out.png", {"--plan", "plan.json", "--map", "ball=b.spa"}).exit_code, 1);
    EXPECT_EQ(render("out.png", {"--plan", "plan.json", "--reference"}).exit_code, 1);
    EXPECT_EQ(render("out.png", {"scene.glb", "--plan-only"}).exit_code, 1);
    EXPECT_EQ(render("out.png").exit_code, 1) << "SCENE is still required";
}

} // namespace
} // namespace spa::test
