// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include "../../libspa/measure/bench_bake.h"
#include "../../samples/samples.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace spa::test {
namespace {

using nlohmann::json;

// A run that takes a moment.
std::vector<std::string> tiny(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"bench", "bake", "--levels", "0", "--runs", "1", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

json run_json(std::vector<std::string> arguments) {
    const TemporaryFolder folder;
    arguments.insert(arguments.end(), {"--format", "json"});
    const Outcome outcome = run_spa(arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bench-bake"), report), "");
    return report;
}

TEST(BenchVerb, TimesRadialAndEmbree) {
    const json report =
        run_json(tiny({"--only", "radial,embree", "--sizes", "32x24,16", "--threads", "1,2"}));
    const json& level = report["levels"][0];
    EXPECT_EQ(level["triangles"], 650);
    ASSERT_EQ(level["maps"].size(), 2U);
    EXPECT_EQ(level["maps"][0]["samples"], 32 * 24);
    EXPECT_EQ(level["maps"][1]["samples"], 17 * 17);
    for (const json& map : level["maps"]) {
        ASSERT_EQ(map["timings"].size(), 2U);
        for (const json& row : map["timings"]) {
            const double radial = row["hits"]["radial"]["median"];
            const double embree = row["hits"]["embree"]["median"];
            EXPECT_DOUBLE_EQ(row["ratios"]["embree_radial_hits"].get<double>(), embree / radial);
            EXPECT_GT(embree, row["embree_build"]["median"].get<double>());
            EXPECT_TRUE(row.contains("bake_2_layers"));
            EXPECT_FALSE(row["crossings"].contains("orbit"));
        }
    }
}

TEST(BenchVerb, TimesTheOrbitAndSaysHowManyViews) {
    // Mesa unloads its driver with memory still allocated, which LeakSanitizer cannot tell from ours.
    ASSERT_EQ(setenv("ASAN_OPTIONS", "detect_leaks=0", 1), 0);
    const json report = run_json(tiny({"--only", "orbit,naive", "--sizes", "16x8", "--threads", "1"}));
    EXPECT_NE(report["gl"], "");
    const json& row = report["levels"][0]["maps"][0]["timings"][0];
    EXPECT_GE(row["naive_views_timed"].get<int>(), 32);
    EXPECT_TRUE(row["ratios"].contains("naive_orbit"));
    EXPECT_FALSE(row["hits"].contains("radial"));
}

TEST(BenchVerb, TextFitsAReadme) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa(tiny({"--only", "radial", "--sizes", "8"}), folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) {
        // "±" is two bytes.
        std::size_t columns = 0;
        for (const char c : line) columns += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
        EXPECT_LE(columns, 100U) << line;
    }
}

TEST(BenchVerb, RefusesWhatItDoesNotKnow) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why) {
        const Outcome outcome = run_spa(arguments, folder.path());
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    };
    refused({"bench", "draw"}, "'draw' is not a benchmark; there are bake, trace, layers");
    refused(tiny({"--models", "boot"}), "--models is not for 'spa bench bake'");
    refused(tiny({"--only", "radiall"}), "--only: 'radiall'");
    refused(tiny({"--sizes", "255"}), "is odd");
    refused({"bench", "bake", "--levels", "3..2"}, "--levels");
    refused({"bench", "bake", "--levels", "7"}, "from 0 to 6");
    refused(tiny({"--threads", "0"}), "--threads");
}

TEST(BenchBake, SpreadOfRuns) {
    const measure::Spread odd = measure::spread_of({3, 1, 9});
    EXPECT_EQ(odd.median, 3);
    EXPECT_EQ(odd.min, 1);
    EXPECT_EQ(odd.max, 9);
    EXPECT_EQ(odd.runs, 3U);
    EXPECT_EQ(measure::spread_of({4, 1, 2, 9}).median, 3);
}

TEST(BenchBake, MemoryIsThatOfTheModelAndMore) {
    const Model model = samples::make_sample("boot", 3);
    const std::uint64_t vertices = model.positions.size();
    const std::uint64_t geometry = vertices * (12 + 12 + 8) + model.triangles.size() * (12 + 4);
    const std::uint64_t texture = 4 * (256 * 256 * 4 - 1) / 3 + 2; // with its mips: a geometric series
    EXPECT_NEAR(double(measure::model_bytes(model)), double(geometry + texture), 2000);
    bake::Options small;
    small.grid = small.color_grid = {Mapping::octahedral, 17, 17};
    bake::Options large;
    large.grid = large.color_grid = {Mapping::octahedral, 1025, 1025};
    const auto least = measure::peak_bake_bytes(model, small);
    const auto most = measure::peak_bake_bytes(model, large);
    if (!least || !most) GTEST_SKIP() << "this system does not tell the peak of resident memory";
    EXPECT_GE(*least, measure::model_bytes(model));
    // A point of a surface is 20 bytes, and there are four surfaces.
    EXPECT_GE(*most, *least + 4ULL * 1025 * 1025 * 20);
}

} // namespace
} // namespace spa::test
