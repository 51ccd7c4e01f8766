// SPDX-License-Identifier: Apache-2.0
// `spa batch --from-plan`, and how a plan is read.
#include "../../samples/scenes.h"
#include "../../tools/plan_file.h"
#include "../cli/process.h"
#include "../cli/schema.h"
#include "../support/object_plan.h"
#include "../support/object_scene.h"

#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;
using Names = std::vector<std::string>;

class BatchPlan : public testing::Test {
protected:
    void SetUp() override {
        samples::write_glb(object_scene(), path("scene.glb"));
        plan_ = object_plan(files());
        write_plan();
    }
    [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }
    void write_plan() const { write_file(path("plan.json"), plan_.dump()); }
    // Of the scene, as a bake of it names them.
    [[nodiscard]] ordered_json files() const {
        const Outcome outcome = run_spa(
            {"bake", "scene.glb", "-o", "all.spa", "--size", "8", "--format", "json"}, folder_.path());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        fs::remove(path("all.spa"));
        return ordered_json::parse(outcome.out)["source"]["files"];
    }
    [[nodiscard]] Outcome batch(Names options = {}) const {
        options.insert(options.begin(), {"batch", "--from-plan", "plan.json"});
        return run_spa(options, folder_.path());
    }
    [[nodiscard]] json report(Names options = {}) const {
        options.insert(options.end(), {"--format", "json"});
        const Outcome outcome = batch(options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        json parsed = json::parse(outcome.out);
        EXPECT_EQ(schema_error(load_schema("batch"), parsed), "");
        return parsed;
    }
    // What read_plan says of the plan after `change`.
    [[nodiscard]] std::string refusal(const std::function<void(ordered_json&)>& change) const {
        ordered_json changed = plan_;
        change(changed);
        write_file(path("changed.json"), changed.dump());
        try {
            static_cast<void>(tools::read_plan(path("changed.json")));
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::invalid_data);
            const std::string message = error.what(), name = path("changed.json").string() + ": ";
            EXPECT_EQ(message.rfind(name, 0), 0U) << message;
            return message.substr(std::min(name.size(), message.size()));
        }
        return "read";
    }

    TemporaryFolder folder_;
    ordered_json plan_;
};

TEST_F(BatchPlan, IsReadAsThePlanVerbWritesIt) {
    EXPECT_EQ(schema_error(load_schema("plan"), json(plan_)), "");
    const tools::Plan plan = tools::read_plan(path("plan.json"));
    EXPECT_EQ(plan.objects.size(), plan_["objects"].size());
    EXPECT_EQ(plan.owner_of_map(plan.objects[2]).node, 1U) << "the twin has the ball's";
    EXPECT_TRUE(tools::changed_sources(plan, path("scene.glb")).empty());
}

TEST_F(BatchPlan, BakesWhatIsToBeAMapAsBakeDoes) {
    const json report = this->report();
    ASSERT_EQ(report["assets"].size(), 2U) << "the twin has the ball's map";
    EXPECT_EQ(report["plan"], "plan.json");
    EXPECT_EQ(report["assets"][0]["source"], "maps/ball");
    EXPECT_EQ(report["assets"][0]["node"], 1);
    EXPECT_EQ(report["assets"][0]["size"], "32");
    EXPECT_EQ(report["assets"][1]["triangles"], 12);
    EXPECT_EQ(folder_.names(), (Names{"maps", "maps/ball.spa", "maps/stand.spa", "plan.json", "scene.glb"}));
    for (const auto& [node, map] : {std::pair{"ball", "maps/ball.spa"}, {"3", "maps/stand.spa"}}) {
        ASSERT_EQ(run_spa({"bake", "scene.glb", "--node", node, "-o", "alone.spa", "--size", "32", "--center",
                           "bounds", "--frame", "sphere", "-q"},
                          folder_.path())
                      .exit_code,
                  0);
        EXPECT_TRUE(read_file(path(map)) == read_file(path("alone.spa"))) << map;
    }
}

TEST_F(BatchPlan, IsUpToDateUntilThePlanSaysOtherwise) {
    EXPECT_EQ(report()["counts"]["baked"], 2);
    EXPECT_EQ(report()["counts"]["up_to_date"], 2);
    plan_["objects"][1]["settings"]["size"] = "16";
    write_plan();
    const json changed = report();
    EXPECT_EQ(changed["assets"][0]["reason"], "options");
    EXPECT_EQ(changed["assets"][1]["status"], "up_to_date");
    plan_["objects"][3]["node"] = 4; // the crate itself, in its own space
    plan_["objects"][3]["name"] = "crate";
    write_plan();
    EXPECT_EQ(report({"--dry-run"})["assets"][1]["reason"], "options");
}

TEST_F(BatchPlan, GoesToAnotherFolderAndObeysOptionsAndPatterns) {
    const json report =
        this->report({"-o", "elsewhere", "--include", "maps/b*", "--depth", "f32", "--jobs", "2"});
    ASSERT_EQ(report["assets"].size(), 1U);
    EXPECT_EQ(report["assets"][0]["output"], "elsewhere/maps/ball.spa");
    EXPECT_TRUE(fs::exists(path("elsewhere/maps/ball.spa")));
    EXPECT_FALSE(fs::exists(path("maps")));
    const Outcome shown = run_spa({"inspect", "elsewhere/maps/ball.spa", "--format", "json"}, folder_.path());
    EXPECT_NE(shown.out.find("\"f32\""), std::string::npos);
}

TEST_F(BatchPlan, WarnsOfAnotherScene) {
    EXPECT_EQ(batch({"--dry-run"}).err, "");
    Scene other = object_scene();
    other.cameras[0].vertical_fov = 1;
    samples::write_glb(other, path("scene.glb"));
    EXPECT_NE(batch({"--dry-run"}).err.find("scene.glb: is not what plan.json was made for"),
              std::string::npos);
    fs::remove(path("scene.glb"));
    const Outcome gone = batch();
    EXPECT_EQ(gone.exit_code, int(ExitCode::input_output));
    EXPECT_NE(gone.err.find("scene.glb: the scene of plan.json cannot be read"), std::string::npos)
        << gone.err;
}

TEST_F(BatchPlan, NothingIsWrittenOutsideTheFolder) {
    for (const char* const map : {"../ball.spa", "/tmp/ball.spa", "maps/../../ball.spa", ""})
        EXPECT_NE(refusal([&](ordered_json& plan) {
                      plan["objects"][1]["map"] = map;
                  }).find("which leads out of the plan's folder"),
                  std::string::npos)
            << map;
    fs::create_directories(path("target"));
    fs::create_directory_symlink(path("target"), path("elsewhere"));
    plan_["objects"][1]["map"] = "elsewhere/ball.spa";
    write_plan();
    EXPECT_EQ(batch().exit_code, 0) << "a link that stays inside";
    fs::remove(path("elsewhere"));
    const TemporaryFolder outside;
    fs::create_directory_symlink(outside.path(), path("elsewhere"));
    const Outcome outcome = batch();
    EXPECT_EQ(outcome.exit_code, int(ExitCode::invalid_data));
    EXPECT_NE(outcome.err.find("through a symbolic link"), std::string::npos) << outcome.err;
    EXPECT_TRUE(outside.names().empty());
    EXPECT_EQ(batch({"--follow-links"}).exit_code, 0);
    EXPECT_EQ(outside.names(), Names{"ball.spa"});
}

TEST_F(BatchPlan, WhatIsWrongIsNamedWithItsPlace) {
    EXPECT_EQ(refusal([](ordered_json&) {}), "read");
    struct Case {
        std::function<void(ordered_json&)> change;
        const char* message;
    };
    const Case cases[] = {
        {[](ordered_json& p) { p = 3; }, "the document is no object"},
        {[](ordered_json& p) { p.erase("objects"); }, "the document has no member \"objects\""},
        {[](ordered_json& p) { p["objects"] = "all"; }, "/objects is no array"},
        {[](ordered_json& p) { p["one_size"] = 63; }, "/one_size is odd"},
        {[](ordered_json& p) { p["one_size"] = 100000; }, "/one_size is no whole number from 2 to 8192"},
        {[](ordered_json& p) { p["scene"]["path"] = 1; }, "/scene/path is no text"},
        {[](ordered_json& p) { p["scene"]["files"][0]["bytes"] = -1; }, "/scene/files/0/bytes is no whole"},
        {[](ordered_json& p) { p["objects"][2]["node"] = 0.5; }, "/objects/2/node is no whole number"},
        {[](ordered_json& p) { p["objects"][2]["node"] = 1; }, "/objects/2/node is 1, as that of an object"},
        {[](ordered_json& p) { p["objects"][2]["same_as"] = 0; },
         "/objects/2/same_as is 0, which is no object"},
        {[](ordered_json& p) { p["objects"][0]["decision"] = "melt"; }, "/objects/0/decision is 'melt'"},
        {[](ordered_json& p) { p["objects"][1]["settings"] = nullptr; }, "/objects/1/settings: is an object"},
        {[](ordered_json& p) { p["objects"][1]["settings"]["size"] = "31"; },
         "/objects/1/settings: --size: '31'"},
        {[](ordered_json& p) { p["objects"][1]["settings"]["sise"] = 8; }, "there is no option 'sise'"},
        {[](ordered_json& p) { p["objects"][1]["map"] = "ball.glb"; }, "/objects/1/map is 'ball.glb', which"},
        {[](ordered_json& p) { p["objects"][3]["map"] = "maps/./ball.spa"; },
         "/objects/3/map is 'maps/ball.spa'"},
    };
    for (const Case& one : cases) {
        const std::string message = refusal(one.change);
        EXPECT_NE(message.find(one.message), std::string::npos) << message << "\nexpected: " << one.message;
    }
    write_file(path("plan.json"), "{");
    EXPECT_NE(batch().err.find("plan.json: is not JSON"), std::string::npos);
    EXPECT_EQ(run_spa({"batch", "scene.glb", "--from-plan", "plan.json"}, folder_.path()).exit_code, 1);
    EXPECT_EQ(run_spa({"batch", "--from-plan", "nowhere.json"}, folder_.path()).exit_code, 2);
    EXPECT_EQ(run_spa({"batch"}, folder_.path()).exit_code, 1) << "IN is still required";
}

} // namespace
} // namespace spa::test
