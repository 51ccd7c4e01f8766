// SPDX-License-Identifier: Apache-2.0
// Maps that a target decides: `spa bake --target-error` and `spa batch` with it.
#include "process.h"
#include "schema.h"

#include "../../formats/container/reader.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spa::test {
namespace {

using nlohmann::json;

class SearchVerb : public testing::Test {
protected:
    void SetUp() override {
        const Outcome outcome = run_spa({"sample", "boot", "--level", "1", "-o", "boot.glb"}, folder_.path());
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }

    // Of boot.glb, with as little to decide as possible.
    Outcome bake(const std::string& output, std::vector<std::string> options) {
        std::vector<std::string> arguments{"bake",    "boot.glb", "-o",       output,   "--format", "json",
                                           "--frame", "sphere",   "--center", "bounds", "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_spa(arguments, folder_.path());
    }
    [[nodiscard]] container::File open(const std::string& name) const {
        container::File opened;
        EXPECT_TRUE(container::open((folder_.path() / name).string(), opened).ok());
        return opened;
    }

    TemporaryFolder folder_;
};

TEST_F(SearchVerb, BakesWhatItsChoiceGivesByHand) {
    const Outcome outcome = bake("boot.spa", {"--target-error", "0.05", "--max-bytes", "1M"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bake"), report), "");
    const json search = report["search"];
    EXPECT_EQ(search["met"], true);
    EXPECT_LE(search["error"], 0.05);
    EXPECT_EQ(search["error"], report["figures"]["rays"]["distance"]["p95"]);
    EXPECT_GT(search["tried"].size(), 2U);
    const json chosen = search["chosen"];
    for (const auto& [key, value] : chosen.items()) EXPECT_EQ(report["options"][key], value) << key;

    const Outcome by_hand =
        bake("hand.spa", {"--measure", "--size", chosen["size"], "--color-size", chosen["color_size"],
                          "--depth", chosen["depth"], "--layers", std::to_string(int(chosen["layers"]))});
    ASSERT_EQ(by_hand.exit_code, 0) << by_hand.err;
    EXPECT_EQ(json::parse(by_hand.out)["figures"], report["figures"]);
    const container::File a = open("boot.spa"), b = open("hand.spa");
    ASSERT_EQ(a.sections().size(), b.sections().size());
    std::size_t same = 0;
    for (std::size_t i = 0; i < a.sections().size(); ++i)
        same += std::size_t(a.sections()[i].checksum == b.sections()[i].checksum);
    EXPECT_EQ(same + 1, a.sections().size()); // all but the metadata

    const json metadata = json::parse(a.map().metadata);
    EXPECT_EQ(metadata["options"], report["options"]);
    EXPECT_EQ(metadata["key"], report["key"]);
    EXPECT_EQ(metadata["request"]["target_error"], 0.05);
    EXPECT_FALSE(metadata["request"].contains("size"));
    EXPECT_EQ(metadata["search"]["tried"], search["tried"].size());
    EXPECT_EQ(metadata["search"]["error"], search["error"]);
}

TEST_F(SearchVerb, SameBytesForAnyNumberOfThreads) {
    ASSERT_EQ(bake("one.spa", {"--target-error", "0.08", "--threads", "1"}).exit_code, 0);
    ASSERT_EQ(bake("two.spa", {"--target-error", "0.08", "--threads", "3"}).exit_code, 0);
    EXPECT_EQ(read_file(folder_.path() / "one.spa"), read_file(folder_.path() / "two.spa"));
}

TEST_F(SearchVerb, WritesNothingWhereNoMapMeetsTheTarget) {
    const Outcome outcome = bake("boot.spa", {"--target-error", "1e-6", "--size", "16", "--layers", "1"});
    EXPECT_EQ(outcome.exit_code, 6);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("boot.glb: no map has a p95-dt of at most 1e-06"), std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("16 is the largest size"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"boot.glb"}));

    const Outcome small = bake("boot.spa", {"--target-error", "0.01", "--max-bytes", "4K"});
    EXPECT_EQ(small.exit_code, 6);
    EXPECT_NE(small.err.find("--max-bytes stopped it"), std::string::npos) << small.err;
}

TEST_F(SearchVerb, BestIsWrittenAndStillMissesTheLimit) {
    const Outcome outcome = bake("boot.spa", {"--target-error", "1e-6", "--size", "16", "--best"});
    EXPECT_EQ(outcome.exit_code, 6);
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bake"), report), "");
    EXPECT_EQ(report["search"]["met"], false);
    EXPECT_EQ(report["search"]["stopped_by"], "size");
    EXPECT_EQ(open("boot.spa").map().parts.at(0).layers.at(0).outer.depth.width, 17U);
}

TEST_F(SearchVerb, RefusesOptionsThatContradict) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
        {{"--best"}, "--best is of a search: give --target-error or --footprint too"},
        {{"--max-bytes", "1M"}, "--max-bytes is of a search"},
        {{"--target-metric", "hausdorff"}, "--target-metric is of a search"},
        {{"--target-error", "0"}, "--target-error: '0' is no error that a map can keep"},
        {{"--footprint", "60"}, "--footprint: '60' is not above 0 and at most 45 degrees"},
        {{"--footprint", "1", "--target-metric", "false-hits"}, "--footprint says nothing about false-hits"},
        {{"--target-error", "1", "--mapping", "latlong", "--target-metric", "p95-dt"},
         "which latlong maps are not traced by"},
        {{"--target-error", "1", "--paper"}, "a search takes latlong maps of N by N/2 texels"},
    };
    for (const auto& [options, message] : wrong) {
        const Outcome outcome = bake("boot.spa", options);
        EXPECT_EQ(outcome.exit_code, 1) << message;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"boot.glb"}));
}

TEST_F(SearchVerb, AFootprintIsATargetForDepthAndColor) {
    const Outcome outcome = bake("boot.spa", {"--footprint", "20"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json search = json::parse(outcome.out)["search"];
    EXPECT_NEAR(double(search["target"]), 0.0364, 1e-4); // a tenth of tan 20 degrees
    EXPECT_EQ(search["footprint"], 20);
}

TEST_F(SearchVerb, BatchKnowsAMapByWhatWasAskedFor) {
    std::filesystem::create_directory(folder_.path() / "in");
    std::filesystem::rename(folder_.path() / "boot.glb", folder_.path() / "in/boot.glb");
    const auto batch = [&](const std::string& target) {
        write_file(folder_.path() / "config.json",
                   R"({"options": {"frame": "sphere", "center": "bounds", "target_error": )" + target + "}}");
        const Outcome outcome =
            run_spa({"batch", "in", "-o", "out", "--config", "config.json", "--format", "json", "--quiet"},
                    folder_.path());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const json report = json::parse(outcome.out);
        EXPECT_EQ(schema_error(load_schema("batch"), report), "");
        return report["assets"][0];
    };
    const json first = batch("0.08");
    EXPECT_EQ(first["status"], "baked");
    const std::uint32_t width = open("out/boot.spa").map().parts.at(0).layers.at(0).outer.depth.width;
    EXPECT_EQ(first["size"], std::to_string(width - 1));
    const json second = batch("0.08");
    EXPECT_EQ(second["status"], "up_to_date");
    EXPECT_EQ(second["size"], first["size"]);
    const json third = batch("0.2");
    EXPECT_EQ(third["status"], "baked");
    EXPECT_EQ(third["reason"], "options");
}

} // namespace
} // namespace spa::test
