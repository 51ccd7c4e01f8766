// SPDX-License-Identifier: Apache-2.0
// `spa batch` as a user runs it, where nothing goes wrong but assets. ../faults has the rest.
#include "../../formats/container/reader.h"
#include "../cli/process.h"
#include "../cli/schema.h"

#include <gtest/gtest.h>

#include <set>

namespace spa::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Names = std::vector<std::string>;

class BatchVerb : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_.path() / "in/props/deep");
        sample("cube", "in/cube.glb");
        sample("boot", "in/props/boot.glb");
        sample("torus", "in/props/deep/torus.glb");
    }
    void sample(const std::string& name, const std::string& path) const {
        ASSERT_EQ(run_spa({"sample", name, "--level", "0", "-o", path}, folder_.path()).exit_code, 0);
    }
    [[nodiscard]] Outcome batch(const std::vector<std::string>& options = {}) const {
        std::vector<std::string> arguments{"batch", "in", "-o", "out", "--size", "16"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_spa(arguments, folder_.path());
    }
    // The report of a run that is to end with this code.
    [[nodiscard]] json report(const std::vector<std::string>& options = {}, int exit_code = 0) const {
        std::vector<std::string> all{"--format", "json"};
        all.insert(all.end(), options.begin(), options.end());
        const Outcome outcome = batch(all);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
        json parsed = json::parse(outcome.out);
        EXPECT_EQ(schema_error(load_schema("batch"), parsed), "");
        return parsed;
    }
    // "name: status", in the order of the report.
    static Names statuses(const json& report) {
        Names all;
        for (const json& asset : report["assets"])
            all.push_back(asset["source"].get<std::string>() + ": " + asset["status"].get<std::string>());
        return all;
    }
    [[nodiscard]] std::string file(const std::string& name) const { return read_file(folder_.path() / name); }
    [[nodiscard]] Names outputs() const {
        Names names;
        for (const std::string& name : folder_.names())
            if (name.starts_with("out/")) names.push_back(name);
        return names;
    }

    TemporaryFolder folder_;
};

const Names all_outputs{"out/cube.spa", "out/props", "out/props/boot.spa", "out/props/deep",
                        "out/props/deep/torus.spa"};

TEST_F(BatchVerb, MirrorsTheTreeWithTheBytesOfBake) {
    const Outcome outcome = batch();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("3 assets: 3 baked, 0 up to date, 0 failed\n", 0), 0U) << outcome.out;
    for (const char* name : {"cube.glb", "props/boot.glb", "props/deep/torus.glb"})
        EXPECT_NE(outcome.err.find(std::string(name) + ": baked (new)"), std::string::npos) << outcome.err;
    EXPECT_EQ(outputs(), all_outputs);
    ASSERT_EQ(run_spa({"bake", "in/props/boot.glb", "-o", "alone.spa", "--size", "16", "-q"}, folder_.path())
                  .exit_code,
              0);
    EXPECT_EQ(file("out/props/boot.spa"), file("alone.spa"));
}

TEST_F(BatchVerb, SameBytesForAnyNumberOfJobsAndThreads) {
    ASSERT_EQ(batch({"--jobs", "1"}).exit_code, 0);
    std::vector<std::string> first;
    for (const std::string& name : all_outputs)
        if (name.ends_with(".spa")) first.push_back(file(name));
    ASSERT_EQ(batch({"--jobs", "3", "--threads", "2", "--force"}).exit_code, 0);
    std::vector<std::string> second;
    for (const std::string& name : all_outputs)
        if (name.ends_with(".spa")) second.push_back(file(name));
    EXPECT_EQ(first, second);
}

TEST_F(BatchVerb, SecondRunBakesNothing) {
    ASSERT_EQ(batch().exit_code, 0);
    const json second = report();
    EXPECT_EQ(statuses(second), (Names{"cube.glb: up_to_date", "props/boot.glb: up_to_date",
                                       "props/deep/torus.glb: up_to_date"}));
    EXPECT_EQ(second["counts"], (json{{"baked", 0}, {"up_to_date", 3}, {"failed", 0}, {"not_started", 0}}));
    EXPECT_GT(second["assets"][1]["triangles"], 0);
    EXPECT_EQ(second["assets"][1]["output_bytes"], file("out/props/boot.spa").size());
}

TEST_F(BatchVerb, OnlyWhatChangedIsBakedAgain) {
    ASSERT_EQ(batch().exit_code, 0);
    sample("sphere", "in/cube.glb");
    const json changed = report();
    EXPECT_EQ(statuses(changed),
              (Names{"cube.glb: baked", "props/boot.glb: up_to_date", "props/deep/torus.glb: up_to_date"}));
    EXPECT_EQ(changed["assets"][0]["reason"], "sources");
    const json other = report({"--layers", "1"});
    for (const json& asset : other["assets"]) EXPECT_EQ(asset["reason"], "options");
    const json forced = report({"--layers", "1", "--force"});
    for (const json& asset : forced["assets"]) EXPECT_EQ(asset["reason"], "forced");
}

TEST_F(BatchVerb, DamagedMapsAreBakedAgain) {
    ASSERT_EQ(batch().exit_code, 0);
    const std::string good = file("out/cube.spa");
    write_file(folder_.path() / "out/cube.spa", good.substr(0, 100));
    EXPECT_EQ(report()["assets"][0]["reason"], "damaged");
    EXPECT_EQ(file("out/cube.spa"), good);
}

TEST_F(BatchVerb, MalformedAssetsAreNamedAndTheOthersBaked) {
    write_file(folder_.path() / "in/bad.obj", "garbage\n");
    write_file(folder_.path() / "in/props/empty.glb", "");
    const json mixed = report({}, 3);
    EXPECT_EQ(statuses(mixed), (Names{"bad.obj: failed", "cube.glb: baked", "props/boot.glb: baked",
                                      "props/deep/torus.glb: baked", "props/empty.glb: failed"}));
    EXPECT_EQ(mixed["assets"][0]["exit_code"], 3);
    EXPECT_EQ(mixed["assets"][0]["error"].get<std::string>().rfind("in/bad.obj: line 1", 0), 0U);
    EXPECT_EQ(outputs(), all_outputs) << "a failed asset leaves no file and no folder";
    const Outcome outcome = batch();
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.out.find("failed  exit 3: in/bad.obj: line 1"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("spa: 2 of 5 assets failed"), std::string::npos) << outcome.err;
}

TEST_F(BatchVerb, AnOldMapOfAnAssetThatFailsNowStays) {
    ASSERT_EQ(batch().exit_code, 0);
    const std::string old = file("out/cube.spa");
    write_file(folder_.path() / "in/cube.glb", "garbage");
    EXPECT_EQ(batch().exit_code, 3);
    EXPECT_EQ(file("out/cube.spa"), old);
}

TEST_F(BatchVerb, DryRunWritesNothingAndSaysWhy) {
    const Outcome outcome = batch({"--dry-run"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "3 assets: 3 to bake, 0 up to date, 0 failed\n"
                           "  new     cube.glb\n  new     props/boot.glb\n  new     props/deep/torus.glb\n");
    EXPECT_FALSE(fs::exists(folder_.path() / "out"));
    ASSERT_EQ(batch().exit_code, 0);
    EXPECT_EQ(batch({"--dry-run"}).out, "3 assets: 0 to bake, 3 up to date, 0 failed\n");
}

// Nothing is baked, so there are no pictures to show.
TEST_F(BatchVerb, DryRunsHaveReportsToo) {
    const Outcome outcome = batch({"--dry-run", "--report", "dry.json", "--report", "dry.html"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(json::parse(file("dry.json"))["dry_run"], true);
    EXPECT_NE(file("dry.html").find("</html>"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder_.path() / "out"));
}

TEST_F(BatchVerb, ShardsTogetherAreTheWhole) {
    for (int i = 0; i < 8; ++i) sample("cube", "in/c" + std::to_string(i) + ".glb");
    std::set<std::string> seen;
    for (const char* shard : {"1/3", "2/3", "3/3"})
        for (const std::string& status : statuses(report({"--shard", shard})))
            EXPECT_TRUE(seen.insert(status).second) << status;
    EXPECT_EQ(seen.size(), 11U);
    EXPECT_EQ(report()["counts"]["up_to_date"], 11);
}

TEST_F(BatchVerb, ConfigSetsOptionsByPattern) {
    write_file(folder_.path() / "c.json",
               R"({"options": {"layers": 1}, "patterns": [{"match": "props", "options": {"size": 32}}]})");
    const Outcome outcome =
        run_spa({"batch", "in", "-o", "out", "--config", "c.json", "--format", "json"}, folder_.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json parsed = json::parse(outcome.out);
    EXPECT_EQ(parsed["assets"][0]["size"], "256");
    EXPECT_EQ(parsed["assets"][1]["size"], "32");
    std::string metadata;
    ASSERT_TRUE(container::read_metadata((folder_.path() / "out/props/boot.spa").string(), metadata).ok());
    EXPECT_EQ(json::parse(metadata)["options"]["size"], "32");
    EXPECT_EQ(json::parse(metadata)["options"]["layers"], 1);
}

TEST_F(BatchVerb, ReportsAreWrittenAsAskedFor) {
    write_file(folder_.path() / "in/bad.obj", "garbage\n");
    ASSERT_EQ(batch({"--report", "r.json", "--report", "r.html", "-q", "--measure"}).exit_code, 3);
    const json written = json::parse(file("r.json"));
    EXPECT_EQ(schema_error(load_schema("batch"), written), "");
    EXPECT_TRUE(written["assets"][1]["figures"].is_object());
    const std::string page = file("r.html");
    EXPECT_EQ(page.rfind("<!doctype html>", 0), 0U);
    EXPECT_NE(page.find("props/deep/torus.glb"), std::string::npos);
    const auto pictures = [](const std::string& text) {
        std::size_t count = 0;
        const std::string png = "iVBORw0KGgo"; // how every PNG file begins, in base64
        for (std::size_t at = text.find(png); at != std::string::npos; at = text.find(png, at + 1)) ++count;
        return count;
    };
    EXPECT_EQ(pictures(page), 3U);
    ASSERT_EQ(batch({"--report", "again.html", "-q", "--measure"}).exit_code, 3);
    EXPECT_EQ(pictures(file("again.html")), pictures(page)) << "maps that are up to date have pictures too";
}

TEST_F(BatchVerb, QuietSaysOnlyWhatWentWrong) {
    const Outcome outcome = batch({"-q"});
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out, "");
}

TEST_F(BatchVerb, NothingFoundIsNoError) {
    const Outcome outcome = batch({"--include", "nothing"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out.rfind("0 assets: ", 0), 0U) << outcome.out;
}

TEST_F(BatchVerb, WrongUsageIsToldBeforeAnythingIsWritten) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"--jobs", "0"}, "--jobs"},
        {{"--memory", "lots"}, "is not a size such as 8G"},
        {{"--memory", "1M"}, "less than any bake needs"},
        {{"--timeout", "0"}, "--timeout"},
        {{"--shard", "5/4"}, "--shard"},
        {{"--report", "r.txt"}, "neither with .json nor with .html"},
        {{"--layers", "0"}, "--layers: '0'"},
        {{"--from-plan", "x"}, "--from-plan"},
    };
    for (const auto& [options, message] : wrong) {
        const Outcome outcome = batch(options);
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(folder_.path() / "out"));
    }
    EXPECT_EQ(batch({"--report", "none/r.json"}).exit_code, 2);
    EXPECT_EQ(batch({"--config", "none.json"}).exit_code, 2);
    EXPECT_EQ(run_spa({"batch", "none", "-o", "out"}, folder_.path()).exit_code, 2);
}

TEST_F(BatchVerb, AListOnStandardInput) {
    const Outcome outcome = run_spa({"batch", "-", "-o", "out", "--size", "16", "-q"}, folder_.path(),
                                    "in/cube.glb\nin/props/boot.glb\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outputs(), (Names{"out/in", "out/in/cube.spa", "out/in/props", "out/in/props/boot.spa"}));
}

} // namespace
} // namespace spa::test
