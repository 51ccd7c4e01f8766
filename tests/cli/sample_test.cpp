// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include "../../samples/scenes.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

TEST(SampleVerb, WritesEverySample) {
    const TemporaryFolder folder;
    std::vector<std::string> names;
    for (const auto& list : {samples::list(), samples::list_scenes()})
        for (const samples::Sample& sample : list) names.emplace_back(sample.name);
    for (const std::string& name : names) {
        const Outcome outcome =
            run_spa({"sample", name, "--level", "0", "-o", name + ".glb", "--format", "json"}, folder.path());
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const nlohmann::json report = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(schema_error(load_schema("sample"), report), "");
        EXPECT_EQ(report["sample"], name);
        const std::string bytes = read_file(folder.path() / (name + ".glb"));
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        EXPECT_EQ(report["output"]["bytes"], bytes.size());
    }
}

TEST(SampleVerb, BootHasThePapersVertices) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_spa({"sample", "boot", "--level", "2", "-o", "boot.glb", "--format", "json"}, folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["vertices"], 5233);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"boot.glb"});
}

TEST(SampleVerb, ScenesAreListed) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa({"help", "sample"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const samples::Sample& scene : samples::list_scenes())
        EXPECT_NE(outcome.out.find(" " + std::string(scene.name) + ": "), std::string::npos) << outcome.out;
}

TEST(SampleVerb, TextNamesTheFile) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa({"sample", "cube", "-o", "c.glb"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("c.glb: cube, level ", 0), 0U) << outcome.out;
    EXPECT_EQ(outcome.err, "");
}

} // namespace
} // namespace spa::test
