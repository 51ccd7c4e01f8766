// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <tuple>

namespace spa::test {
namespace {

using nlohmann::json;

std::vector<std::string> quick(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"bench", "layers", "--quick", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

json report_of(const std::vector<std::string>& more) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = quick(more);
    arguments.insert(arguments.end(), {"--format", "json"});
    const Outcome outcome = run_spa(arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bench-layers"), report), "");
    return report;
}

const json& row_of(const json& rows, const std::string& reconstruction, int layers, int cells) {
    static const json none;
    for (const json& row : rows)
        if (row["reconstruction"] == reconstruction && row["layers"] == layers && row["cells"] == cells)
            return row;
    ADD_FAILURE() << "no " << reconstruction << " " << layers << " " << cells;
    return none;
}

TEST(BenchLayersVerb, HasARowForEveryReconstructionNumberOfLayersAndSize) {
    const json report = report_of({"torus:2", "--sizes", "32,16,32", "--layers", "2,1", "--rays", "2000"});
    EXPECT_EQ(report["rays"], 2000);
    EXPECT_EQ(report["center"], "bounds");
    const json& mesh = report["meshes"][0];
    EXPECT_EQ(mesh["mesh"], "torus-2");
    EXPECT_EQ(mesh["source"], "torus:2");
    EXPECT_EQ(mesh["closed"], true);
    EXPECT_FALSE(mesh.contains("losses"));
    std::vector<std::tuple<int, std::string, int>> rows;
    for (const json& row : mesh["rows"]) {
        rows.emplace_back(row["cells"], row["reconstruction"], row["layers"]);
        EXPECT_EQ(row["time_ratio"].is_number(), row["reconstruction"] != "one_depth");
        std::uint64_t rays = 0;
        for (const char* const part : {"band", "interior"})
            for (const auto& [name, count] : row[part].items()) rays += count.get<std::uint64_t>();
        EXPECT_EQ(rays, 2000U);
        const double extra = row["band"]["extra"].get<double>() + row["interior"]["extra"].get<double>();
        EXPECT_NEAR(row["false_hits"], extra / 2000, 1e-12);
        EXPECT_NEAR(row["band_width"], 4.0 / row["cells"].get<int>(), 1e-12);
        EXPECT_EQ(row["times"]["runs"], 1);
    }
    const std::vector<std::tuple<int, std::string, int>> expected{
        {16, "one_depth", 1}, {16, "tangents", 1}, {16, "tangents", 2}, {16, "folds", 1}, {16, "folds", 2},
        {32, "one_depth", 1}, {32, "tangents", 1}, {32, "tangents", 2}, {32, "folds", 1}, {32, "folds", 2}};
    EXPECT_EQ(rows, expected);
}

TEST(BenchLayersVerb, FindsWhatIsKnownOfATorus) {
    const json report = report_of({"torus", "--size", "64", "--layers", "1,2"});
    const json& rows = report["meshes"][0]["rows"];
    const json& one_depth = row_of(rows, "one_depth", 1, 64);
    const json& tangents = row_of(rows, "tangents", 2, 64);
    const json& folds = row_of(rows, "folds", 2, 64);
    // One depth fills the hole, most of it far from any silhouette of the mesh.
    EXPECT_GT(one_depth["interior_false"], 0.01);
    EXPECT_GT(one_depth["false_hits"].get<double>(), 5 * tangents["false_hits"].get<double>());
    EXPECT_EQ(tangents["interior_false"], 0);
    EXPECT_EQ(tangents["interior_missed"], 0);
    EXPECT_LE(folds["false_hits"], tangents["false_hits"]);
    EXPECT_LT(folds["distance_mean"], one_depth["distance_mean"]);
    // From its centre no direction meets a torus twice: its second interval changes nothing.
    EXPECT_EQ(row_of(rows, "tangents", 1, 64)["band"], tangents["band"]);
    EXPECT_EQ(row_of(rows, "tangents", 1, 64)["file_bytes"], tangents["file_bytes"]);
    EXPECT_EQ(folds["fold_bytes"].get<double>(),
              folds["file_bytes"].get<double>() - tangents["file_bytes"].get<double>());
    EXPECT_NEAR(folds["fold_share"], folds["fold_bytes"].get<double>() / folds["file_bytes"].get<double>(),
                1e-9);
    EXPECT_EQ(tangents["fold_bytes"], 0);
    EXPECT_GT(tangents["mixed_triangles"], 0);
    EXPECT_LT(tangents["mixed_triangles"], 0.2);
}

TEST(BenchLayersVerb, MeansAreOfClosedMeshesAndOpenOnesSayWhatTheyLose) {
    const json report = report_of({"torus:2", "boot:2", "concave", "--layers", "2,3"});
    ASSERT_EQ(report["meshes"].size(), 3U);
    EXPECT_EQ(report["meshes"][1]["closed"], false);
    EXPECT_GT(report["meshes"][1]["open_edges"], 0);
    EXPECT_NE(report["meshes"][1]["losses"].get<std::string>().find("N=128 with 2 intervals"),
              std::string::npos);
    EXPECT_EQ(report["closed_mean"]["meshes"], 2);
    const json& mean = row_of(report["closed_mean"]["rows"], "folds", 2, 128);
    const json& torus = row_of(report["meshes"][0]["rows"], "folds", 2, 128);
    const json& concave = row_of(report["meshes"][2]["rows"], "folds", 2, 128);
    for (const char* const figure : {"false_hits", "distance_p99", "ns", "file_bytes"})
        EXPECT_NEAR(mean[figure], (torus[figure].get<double>() + concave[figure].get<double>()) / 2,
                    1e-9 * std::max(1.0, mean[figure].get<double>()))
            << figure;
    // Without one interval there is nothing to relate times to.
    EXPECT_FALSE(mean.contains("time_ratio"));
    std::set<std::string> bars;
    for (const json& bar : report["bars"]) {
        bars.insert(bar["bar"]);
        EXPECT_EQ(bar["reached"],
                  bar["at_least"].get<bool>() ? bar["value"] >= bar["limit"] : bar["value"] <= bar["limit"]);
        EXPECT_EQ(bar.contains("mesh"), bar["bar"] == "false hits, one depth against folds");
        if (bar.contains("mesh")) {
            EXPECT_EQ(bar["mesh"], "boot-2");
        }
    }
    EXPECT_EQ(bars, (std::set<std::string>{"false hits", "missed hits", "mean |dt|", "interior false hits",
                                           "interior missed hits", "fold records in the file",
                                           "false hits, one depth against folds"}));
}

TEST(BenchLayersVerb, TheSeedChoosesTheRays) {
    const std::vector<std::string> small{"torus:2", "--sizes", "16", "--layers", "2", "--rays", "3000"};
    const auto distance = [&](const std::string& seed, const std::string& threads) {
        std::vector<std::string> arguments = small;
        arguments.insert(arguments.end(), {"--seed", seed, "--threads", threads});
        return report_of(arguments)["meshes"][0]["rows"][1]["distance"];
    };
    const json first = distance("1", "1");
    EXPECT_EQ(first, distance("1", "2")) << "threads change times alone";
    EXPECT_NE(first, distance("2", "1"));
}

TEST(BenchLayersVerb, TextFitsAReadme) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa(quick({"boot:2", "cube", "torus:2"}), folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 110U) << line;
    for (const char* const part :
         {"boot-2: 10400 triangles in 1 piece, open: ", "one depth", "tangents", "Lost at N=128",
          "Mean of 2 closed meshes", "interior false hits", "worst size, N="})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
}

TEST(BenchLayersVerb, WritesAFolder) {
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    const Outcome outcome =
        run_spa(quick({"torus:2", "torus:2", "--size", "32", "--layers", "2", "--out", "o"}), folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(folder.names(),
              (std::vector<std::string>{"o", "o/layers-mean.gnuplot", "o/layers-mean.png",
                                        "o/layers-torus-2-2.gnuplot", "o/layers-torus-2-2.png",
                                        "o/layers-torus-2.gnuplot", "o/layers-torus-2.png", "o/layers.csv",
                                        "o/report.json", "o/report.txt", "o/views-torus-2-2.png",
                                        "o/views-torus-2.png"}));
    EXPECT_EQ(read_file(folder.path() / "o/report.txt"), outcome.out);
    const json report = json::parse(read_file(folder.path() / "o/report.json"));
    EXPECT_EQ(schema_error(load_schema("bench-layers"), report), "");
    for (const char* const name : {"o/views-torus-2.png", "o/layers-mean.png"}) {
        const std::string png = read_file(folder.path() / name);
        EXPECT_TRUE(png.starts_with("\x89PNG")) << name;
        EXPECT_GT(png.size(), 10000U) << name;
    }
    std::istringstream csv(read_file(folder.path() / "o/layers.csv"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(csv, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 1U + 3 * 3); // both meshes and the mean
    for (const std::string& line : lines)
        EXPECT_EQ(std::count(line.begin(), line.end(), ','),
                  std::count(lines[0].begin(), lines[0].end(), ','));
    EXPECT_TRUE(lines[1].starts_with("torus-2,true,one_depth,1,32,")) << lines[1];
    EXPECT_TRUE(lines[9].starts_with("closed mean,true,folds,2,32,")) << lines[9];
}

TEST(BenchLayersVerb, RefusesWhatItDoesNotKnow) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why,
                             int code = 1) {
        const Outcome outcome = run_spa(arguments, folder.path());
        EXPECT_EQ(outcome.exit_code, code) << why;
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    };
    refused(quick({}), "wants at least one ASSET");
    refused(quick({"torus", "--models", "torus"}), "--models is not for 'spa bench layers'");
    refused(quick({"torus", "--plots", "p"}), "--plots is not for 'spa bench layers'");
    refused(quick({"torus", "--size", "33"}), "--size: '33' is odd");
    refused(quick({"torus", "--layers", "0"}), "--layers");
    refused(quick({"torus", "--seed", "-1"}), "--seed");
    refused(quick({"torus", "--center", "middle"}), "--center");
    refused(quick({"torus:7"}), "ASSET: '7'");
    refused(quick({"nothing.glb"}), "nothing.glb", 2);
    refused({"bench", "trace", "torus"}, "ASSET is not for 'spa bench trace'");
    refused({"bench", "bake", "--seed", "1"}, "--seed is not for 'spa bench bake'");
}

} // namespace
} // namespace spa::test
