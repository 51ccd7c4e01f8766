// SPDX-License-Identifier: Apache-2.0
// `spa bench paper` on software Vulkan, small.
#include "process.h"
#include "schema.h"
#include "vulkan_test.h"

#include "../../tools/paper_printed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

namespace spa::test {
namespace {

using nlohmann::json;

Outcome quick(const std::vector<std::string>& more, const std::filesystem::path& folder) {
    std::vector<std::string> arguments{"bench", "paper", "--quick", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_spa(arguments, folder);
}

std::set<std::string> files_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

const json& cell(const json& report, const std::string& method, int samples) {
    static const json none;
    for (const json& cell : report["cells"])
        if (cell["method"] == method && cell["samples"] == samples) return cell;
    ADD_FAILURE() << "no " << method << " with " << samples;
    return none;
}

class BenchPaperVerb : public VulkanVerbTest {};

TEST_F(BenchPaperVerb, MeasuresEveryCellOfATable) {
    const TemporaryFolder folder;
    const Outcome outcome =
        quick({"--levels", "1", "--only", "tables", "--out", "out", "--format", "json"}, folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bench-paper"), report), "");
    ASSERT_EQ(report["cells"].size(), 9U * 2U);
    for (const int samples : {8, 32}) {
        const json& triangles = cell(report, "triangles", samples);
        EXPECT_EQ(triangles["ratio_to_triangles"], 1.0);
        EXPECT_EQ(triangles["relmse_equal_seeds"], 0.0);
        EXPECT_EQ(triangles["printed_frames_per_second"], samples == 8 ? 42.3 : 12.8);
        EXPECT_FALSE(cell(report, "projective", samples).contains("printed_frames_per_second"));
        // All see the same primary hits, so all ask for the same secondary rays, most of them the same
        // number.
        EXPECT_EQ(cell(report, "fan 0", samples)["secondary_rays"], triangles["secondary_rays"]);
        // The sphere is worse than ten test rays, and those are worse than the surface between the samples.
        const double sphere = cell(report, "fan 0", samples)["relmse_equal_seeds"];
        const double fan = cell(report, "fan 10", samples)["relmse_equal_seeds"];
        const double map = cell(report, "projective", samples)["relmse_equal_seeds"];
        EXPECT_LT(fan, sphere / 2);
        EXPECT_LT(map, fan / 2);
        EXPECT_GT(map, 0);
    }
    // The same directions first: with more of them the picture is nearer to the reference.
    EXPECT_LT(cell(report, "triangles", 32)["relmse"], cell(report, "triangles", 8)["relmse"]);
    ASSERT_EQ(report["costs"].size(), 1U);
    const json& costs = report["costs"][0];
    EXPECT_EQ(costs["vertices"], 1317);
    EXPECT_GT(costs["triangle_structure_bytes"], 100 * costs["map_structure_bytes"].get<double>());
    EXPECT_EQ(
        files_in(folder.path() / "out"),
        (std::set<std::string>{"fig7-frames.gnuplot", "fig7-frames.png", "report.json", "report.txt",
                               "speed-against-error.gnuplot", "speed-against-error.png", "tables.csv"}));
    std::ifstream csv(folder.path() / "out/tables.csv");
    EXPECT_EQ(std::count(std::istreambuf_iterator<char>(csv), {}, '\n'), 1 + 9 * 2);
}

TEST_F(BenchPaperVerb, DrawsAFigureWithItsErrors) {
    const TemporaryFolder folder;
    const Outcome outcome = quick({"--only", "shadows", "--out", "out", "--format", "json"}, folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bench-paper"), report), "");
    EXPECT_TRUE(report["cells"].empty());
    ASSERT_EQ(report["figures"].size(), 5U);
    EXPECT_EQ(report["figures"][0]["method"], "fan 1");
    EXPECT_LT(report["figures"][4]["relmse"].get<double>(), report["figures"][3]["relmse"].get<double>() / 2);
    EXPECT_EQ(files_in(folder.path() / "out"),
              (std::set<std::string>{"fig4-shadows.png", "report.json", "report.txt"}));
}

TEST(BenchPaperUsage, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--only", "tables"},
                                                      {"--only", "pictures", "--out", "out"},
                                                      {"--levels", "7", "--out", "out"},
                                                      {"--rays", "5", "--out", "out"}}) {
        const Outcome outcome = quick(arguments, folder.path());
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_TRUE(files_in(folder.path()).empty());
    }
    EXPECT_EQ(run_spa({"bench", "trace", "--out", "out"}, folder.path()).exit_code, 1);
    EXPECT_EQ(run_spa({"bench", "bake", "--device", "0"}, folder.path()).exit_code, 1);
}

TEST(PaperPrinted, IsWhatTheTablesSay) {
    using tools::printed_frames_per_second;
    EXPECT_EQ(printed_frames_per_second(0, "fan 0", 8), 128.8);
    EXPECT_EQ(printed_frames_per_second(2, "fan 5", 128), 6.7); // as it is printed, an error or not
    EXPECT_EQ(printed_frames_per_second(4, "fan 1", 8), 56.6);
    EXPECT_EQ(printed_frames_per_second(5, "triangles", 256), 0.3);
    EXPECT_EQ(printed_frames_per_second(6, "fan 10", 32), 11.3);
    EXPECT_FALSE(printed_frames_per_second(6, "fan 10", 64));
    EXPECT_FALSE(printed_frames_per_second(6, "projective", 32));
    EXPECT_FALSE(printed_frames_per_second(7, "fan 10", 32));
}

} // namespace
} // namespace spa::test
