// SPDX-License-Identifier: Apache-2.0
// `spa bake --parts`, and what else the commands do with maps of several parts.
#include "process.h"
#include "schema.h"

#include "../../samples/scenes.h"
#include "../support/object_scene.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using nlohmann::json;
using Arguments = std::vector<std::string>;

class BakeParts : public testing::Test {
protected:
    void SetUp() override { samples::write_glb(object_scene(), folder_.path() / "scene.glb"); }
    [[nodiscard]] Outcome run(const Arguments& arguments) const { return run_spa(arguments, folder_.path()); }
    [[nodiscard]] json bake(const std::string& parts, Arguments more = {}) const {
        more.insert(more.begin(), {"bake", "scene.glb", "--parts", parts, "-o", parts + ".spa", "--size",
                                   "32", "-q", "--format", "json"});
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const json report = json::parse(outcome.out);
        EXPECT_EQ(schema_error(load_schema("bake"), report), "");
        return report;
    }

    TemporaryFolder folder_;
};

TEST_F(BakeParts, NodesAreFollowed) {
    const json report = bake("nodes");
    const std::size_t count = report["report"]["parts"].size();
    ASSERT_GT(count, 1U);
    EXPECT_EQ(report["options"]["parts"], "nodes");
    EXPECT_TRUE(report["report"]["center"].is_null()) << "each part has its own";
    std::uint64_t triangles = 0;
    for (const json& part : report["report"]["parts"]) {
        EXPECT_GE(part["node"], 0);
        EXPECT_EQ(part["joint"], -1);
        triangles += part["triangles"].get<std::uint64_t>();
    }
    EXPECT_EQ(triangles, report["source"]["triangles"]);
    const json inspected = json::parse(run({"inspect", "nodes.spa", "--format", "json"}).out);
    EXPECT_EQ(schema_error(load_schema("inspect"), inspected), "");
    EXPECT_EQ(inspected["parts"].size(), count);
    EXPECT_EQ(inspected["metadata"]["report"]["parts"].size(), count);
    std::size_t binds = 0;
    for (const json& section : inspected["sections"]) binds += section["type"] == "BIND" ? 1U : 0U;
    EXPECT_GT(binds, 0U);
}

TEST_F(BakeParts, OfWhatNoSkinMovesBonesAreNodes) {
    EXPECT_EQ(bake("bones")["report"]["parts"].size(), bake("nodes")["report"]["parts"].size());
}

TEST_F(BakeParts, ValidateMeasuresEveryPart) {
    for (const char* const parts : {"nodes", "auto"}) {
        const json report = bake(parts, {"--measure"});
        const std::string file = std::string(parts) + ".spa";
        const Outcome outcome = run({"validate", file, "--rays", "3000", "--format", "json", "--min-captured",
                                     "0.99", "--max-false-hits", "0.02", "--max-missed-hits", "0.02"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const json valid = json::parse(outcome.out);
        EXPECT_EQ(schema_error(load_schema("validate"), valid), "");
        const std::size_t count = report["report"]["parts"].size();
        EXPECT_EQ(valid["parts"].size(), count == 1 ? 0 : count);
        EXPECT_TRUE(valid["findings"].empty()) << outcome.out;
        EXPECT_EQ(valid["figures"]["captured_area"], report["figures"]["captured_area"]);
    }
}

TEST_F(BakeParts, ATargetIsSearchedOverSizes) {
    Arguments arguments{"bake", "scene.glb",       "-o",          "t.spa",    "--parts", "components",
                        "-q",   "--target-metric", "missed-hits", "--format", "json",    "--target-error"};
    arguments.emplace_back("0.01");
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bake"), report), "");
    const json& search = report["search"];
    EXPECT_EQ(search["met"], true);
    EXPECT_GT(report["report"]["parts"].size(), 1U);
    EXPECT_EQ(search["chosen"]["size"], report["options"]["size"]);
    EXPECT_LE(report["figures"]["rays"]["missed_hits"]["share"], 0.01);
    for (std::size_t i = 0; i + 1 < search["tried"].size(); ++i)
        EXPECT_EQ(search["tried"][i]["met"], false) << "the smallest is taken";
    EXPECT_EQ(run({"validate", "t.spa", "--max-missed-hits", "0.01"}).exit_code, 0);

    arguments.back() = "1e-9";
    arguments.insert(arguments.end(), {"--max-bytes", "20K"});
    arguments[3] = "none.spa";
    const Outcome unmet = run(arguments);
    EXPECT_EQ(unmet.exit_code, 6) << unmet.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "none.spa"));
}

TEST_F(BakeParts, AtMostSoMany) {
    EXPECT_EQ(bake("components", {"--max-parts", "2"})["report"]["parts"].size(), 2U);
    const Outcome outcome =
        run({"bake", "scene.glb", "-o", "x.spa", "--parts", "nodes", "--max-parts", "1", "-q"});
    EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("scene.glb: divides into"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--max-parts 1"), std::string::npos) << outcome.err;
}

TEST_F(BakeParts, WhatDoesNotGoTogetherIsRefused) {
    for (const Arguments& more : std::vector<Arguments>{
             {"--parts", "nodes", "--node", "ball"}, {"--parts", "pieces"}, {"--max-parts", "0"}}) {
        Arguments arguments{"bake", "scene.glb", "-o", "x.spa", "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run(arguments).exit_code, 1) << more[1];
    }
}

} // namespace
} // namespace spa::test
