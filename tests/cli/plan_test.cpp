// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"
#include "vulkan_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace spa::test {
namespace {

using Json = nlohmann::json;

Outcome run_plan(const TemporaryFolder& folder, const std::vector<std::string>& more,
                 const std::string& rays = "4096") {
    std::vector<std::string> arguments{"plan", "scene.glb", "-o", "plan.json", "--rays", rays};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_spa(arguments, folder.path());
}

void make_scene(const TemporaryFolder& folder, const std::string& name, const std::string& level) {
    const Outcome made = run_spa({"sample", name, "--level", level, "-o", "scene.glb"}, folder.path());
    ASSERT_EQ(made.exit_code, 0) << made.err;
}

TEST(PlanVerb, WritesAPlanByItsSchema) {
    const TemporaryFolder folder;
    make_scene(folder, "room", "0");
    const Outcome outcome = run_plan(folder, {"--format", "json", "--camera", "view"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json report = Json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("plan-report"), report), "");
    const std::string text = read_file(folder.path() / "plan.json");
    const Json plan = Json::parse(text);
    EXPECT_EQ(schema_error(load_schema("plan"), plan), "");
    EXPECT_EQ(plan["scene"]["path"], "scene.glb");
    EXPECT_EQ(plan["request"]["camera"], "view");
    EXPECT_EQ(plan["objects"].size(), report["objects"]);
    std::set<std::string> maps;
    for (const Json& object : plan["objects"]) {
        const bool is_map = object["decision"] == "map";
        EXPECT_EQ(is_map, object["map"].is_string());
        EXPECT_EQ(is_map, object["settings"].is_object());
        if (!is_map) continue;
        const std::string map = object["map"];
        EXPECT_EQ(map.rfind("plan.maps/", 0), 0U);
        EXPECT_EQ(maps.insert(map).second, object["same_as"].is_null()) << map;
    }
    EXPECT_GT(maps.size(), 3U);

    // The same again, whatever the number of threads.
    ASSERT_EQ(run_plan(folder, {"--threads", "1", "--camera", "view"}).exit_code, 0);
    EXPECT_EQ(read_file(folder.path() / "plan.json"), text);
}

TEST(PlanVerb, TextNamesObjectsAndSums) {
    const TemporaryFolder folder;
    make_scene(folder, "corner", "2");
    const Outcome outcome = run_plan(folder, {"--views", "2", "--samples", "16"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const std::string line :
         {"\nboot ", "\nleft wall ", "\nobjects ", "\nthe plan ", "\nall triangles "})
        EXPECT_NE(outcome.out.find(line), std::string::npos) << line << outcome.out;
    EXPECT_EQ(outcome.err, "");
}

TEST(PlanVerb, ThePageHoldsNamesAsText) {
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.obj",
               "o <script>alert(1)</script>\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
               "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const Outcome outcome =
        run_spa({"plan", "scene.obj", "-o", "plan.json", "--html", "plan.html", "--rays", "1024", "-q"},
                folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string page = read_file(folder.path() / "plan.html");
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
    EXPECT_NE(page.find("All triangles"), std::string::npos);
}

TEST(PlanVerb, ABudgetTooSmallIsALimitMissed) {
    const TemporaryFolder folder;
    make_scene(folder, "corner", "2");
    const Outcome outcome =
        run_plan(folder, {"--budget-bytes", "2000", "--target-image-error", "1e-5", "--format", "json"});
    EXPECT_EQ(outcome.exit_code, 6);
    EXPECT_NE(outcome.err.find("--budget-bytes"), std::string::npos) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["meets"]["budget_bytes"].get<bool>() &&
                  Json::parse(outcome.out)["meets"]["target_image_error"].get<bool>(),
              false);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"plan.json", "scene.glb"}));
}

TEST(PlanVerb, WrongArgumentsAreRefusedBeforeAnyWork) {
    const TemporaryFolder folder;
    make_scene(folder, "corner", "0");
    const auto refused = [&](const std::vector<std::string>& more, const std::string& says) {
        const Outcome outcome = run_plan(folder, more);
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
    };
    refused({"--camera", "veiw"}, "did you mean 'view'");
    refused({"--camera", "view", "--views", "3"}, "one or the other");
    refused({"--views", "0"}, "--views");
    refused({"--samples", "0"}, "--samples");
    refused({"--largest-size", "100"}, "power of two");
    refused({"--budget-bytes", "-1"}, "--budget-bytes");
    EXPECT_EQ(run_spa({"plan", "scene.glb", "-o", "scene.glb"}, folder.path()).exit_code, 1);
    EXPECT_EQ(run_spa({"plan", "none.glb", "-o", "p.json"}, folder.path()).exit_code, 2);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.glb"});
}

class RenderPredicted : public VulkanVerbTest {};

// The figure that a plan rests on, against pictures.
TEST_F(RenderPredicted, PredictsWhatARenderedPictureLoses) {
    const TemporaryFolder folder;
    make_scene(folder, "corner", "2");
    const std::vector<std::string> picture{"--size", "192x108", "--samples", "32", "--quiet"};
    const auto render = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"render", "scene.glb"});
        arguments.insert(arguments.end(), picture.begin(), picture.end());
        return run_spa(arguments, folder.path());
    };
    ASSERT_EQ(render({"--reference", "-o", "truth.exr"}).exit_code, 0);
    ASSERT_EQ(run_plan(folder, {"--target-image-error", "1e-3"}, "65536").exit_code, 0);
    const Json plan = Json::parse(read_file(folder.path() / "plan.json"));
    for (const Json& object : plan["objects"]) {
        if (object["name"] != "boot") continue;
        ASSERT_EQ(object["decision"], "map");
        ASSERT_EQ(run_spa({"sample", "boot", "--level", "2", "-o", "boot.glb"}, folder.path()).exit_code, 0);
        ASSERT_EQ(run_spa({"bake", "boot.glb", "-o", "boot.spa", "--size", object["settings"]["size"],
                           "--layers", std::to_string(object["settings"]["layers"].get<int>()), "--center",
                           object["settings"]["center"], "--frame", object["settings"]["frame"], "--quiet"},
                          folder.path())
                      .exit_code,
                  0);
        const Outcome rendered =
            render({"--map", "boot=boot.spa", "-o", "map.exr", "--compare", "truth.exr", "--format", "json"});
        ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
        const double measured = Json::parse(rendered.out)["comparison"]["figures"]["indirect"]["relmse"];
        const double predicted = object["expected"]["image_error"];
        EXPECT_GT(measured, predicted / 2);
        EXPECT_LT(measured, predicted * 2);
    }
}

} // namespace
} // namespace spa::test
