// SPDX-License-Identifier: Apache-2.0
// `spa bake --node`: one object of a scene in its own space, and what else the commands do with such a map.
#include "process.h"
#include "schema.h"

#include "../../samples/scenes.h"
#include "../support/object_scene.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using nlohmann::json;
using Arguments = std::vector<std::string>;

class BakeNode : public testing::Test {
protected:
    void SetUp() override { samples::write_glb(object_scene(), path("scene.glb")); }
    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    [[nodiscard]] Outcome run(const Arguments& arguments) const { return run_spa(arguments, folder_.path()); }
    [[nodiscard]] Outcome bake(const std::string& node, const std::string& output,
                               Arguments more = {}) const {
        more.insert(more.begin(), {"bake", "scene.glb", "--node", node, "-o", output, "--size", "32", "-q"});
        return run(more);
    }
    [[nodiscard]] json inspect(const std::string& map) const {
        return json::parse(run({"inspect", map, "--format", "json"}).out);
    }

    TemporaryFolder folder_;
};

TEST_F(BakeNode, IsInTheNodesOwnSpace) {
    const Outcome outcome = bake("ball", "ball.spa", {"--format", "json", "--center", "bounds"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bake"), report), "");
    EXPECT_EQ(report["options"]["node"], 1);
    EXPECT_EQ(report["source"]["node"], "ball");
    EXPECT_EQ(report["source"]["materials"], 1);
    const json part = inspect("ball.spa")["parts"][0];
    EXPECT_NEAR(part["center"][0].get<double>(), 0.2, 1e-6) << part;
    EXPECT_NEAR(part["center"][1].get<double>(), 0, 1e-6);
    EXPECT_NEAR(part["radius"].get<double>(), 0.7, 1e-6);
}

TEST_F(BakeNode, NameAndIndexAreTheSame) {
    ASSERT_EQ(bake("stand", "a.spa").exit_code, 0);
    ASSERT_EQ(bake("3", "b.spa").exit_code, 0);
    EXPECT_EQ(read_file(path("a.spa")), read_file(path("b.spa")));
    ASSERT_EQ(bake("crate", "c.spa").exit_code, 0);
    EXPECT_NE(inspect("a.spa")["metadata"]["key"], inspect("c.spa")["metadata"]["key"]);
}

TEST_F(BakeNode, ValidateMeasuresAgainstTheSameNode) {
    for (const char* const node : {"ball", "twin"}) { // one is mirrored
        ASSERT_EQ(bake(node, "n.spa", {"--measure"}).exit_code, 0);
        const Outcome outcome = run({"validate", "n.spa", "--min-captured", "0.999", "--max-texel-distance",
                                     "0.001", "--max-surface-distance", "0.05", "--max-normal", "25"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        const json report = inspect("n.spa")["metadata"]["report"];
        EXPECT_EQ(report["back_facing_samples"], 0) << "turned inside out";
        EXPECT_EQ(report["center_inside"], true);
    }
}

TEST_F(BakeNode, OfSeveralNodesOfANameItIsTheFirst) {
    Scene scene = object_scene();
    scene.nodes[2].name = "ball";
    samples::write_glb(scene, path("scene.glb"));
    const Outcome outcome = bake("ball", "ball.spa");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("2 nodes have the name 'ball'; the first is taken, number 1"),
              std::string::npos)
        << outcome.err;
    ASSERT_EQ(bake("1", "first.spa").exit_code, 0);
    EXPECT_EQ(read_file(path("ball.spa")), read_file(path("first.spa")));
}

TEST_F(BakeNode, WhatCannotBeBaked) {
    EXPECT_EQ(bake("bal", "x.spa").exit_code, 1);
    EXPECT_NE(
        bake("bal", "x.spa").err.find("scene.glb: --node: there is no node 'bal'; did you mean 'ball'?"),
        std::string::npos);
    EXPECT_EQ(bake("77", "x.spa").exit_code, 1);
    const Outcome lamp = bake("lamp", "x.spa");
    EXPECT_EQ(lamp.exit_code, 3);
    EXPECT_NE(lamp.err.find("neither it nor a node below it draws a triangle"), std::string::npos)
        << lamp.err;
    EXPECT_EQ(folder_.names(), Arguments{"scene.glb"});
}

} // namespace
} // namespace spa::test
