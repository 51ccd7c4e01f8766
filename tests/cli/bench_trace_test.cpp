// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

namespace spa::test {
namespace {

using nlohmann::json;

std::vector<std::string> quick(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"bench", "trace", "--quick", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

const json& find(const json& list, const char* key, const std::string& value) {
    static const json none;
    for (const json& item : list)
        if (item[key] == value) return item;
    ADD_FAILURE() << "no " << value;
    return none;
}

TEST(BenchTraceVerb, ReportsEveryMethodOnEverySetInJson) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa(quick({"--format", "json", "--models", "smooth:2"}), folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("bench-trace"), report), "");
    const json& model = report["models"][0];
    EXPECT_EQ(model["vertices"], 5186);
    std::set<std::string> families;
    for (const json& method : model["methods"]) {
        families.insert(method["family"]);
        ASSERT_EQ(method["sets"].size(), 5U) << method["method"];
        for (const json& set : method["sets"]) {
            std::uint64_t rays = 0;
            for (const char* const part : {"band", "interior"})
                for (const auto& [name, count] : set[part].items()) rays += count.get<std::uint64_t>();
            EXPECT_EQ(rays, 2000U);
            const bool shadow = set["set"] == "shadow";
            EXPECT_EQ(set.contains("distance"), !shadow);
            const bool two_kinds = method["family"] != "fan" && method["family"] != "march";
            const bool two_threads = set["set"] == "chords";
            EXPECT_EQ(set["times"].size(), (two_kinds ? 2U : 1U) * (two_threads ? 2U : 1U));
        }
    }
    EXPECT_EQ(families, (std::set<std::string>{"fan", "lod", "march", "mesh", "projective", "surface"}));
}

TEST(BenchTraceVerb, FindsWhatIsKnown) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_spa(quick({"--format", "json", "--models", "smooth:3", "--sets", "chords", "--rays", "4000"}),
                folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    const json& methods = report["models"][0]["methods"];
    const auto chords = [&](const std::string& method) { return find(methods, "method", method)["sets"][0]; };
    // The mesh is the reference, but for the robust mode.
    EXPECT_LT(chords("mesh")["distance"]["p99"], 1e-5);
    EXPECT_EQ(chords("mesh")["interior"]["missed"], 0);
    EXPECT_LT(chords("mesh")["normal_angle"]["p95"], 0.01);
    // Four times the cells a side, and nearly sixteen times as exact on a smooth shape.
    const json coarse = chords("projective 32x1"), fine = chords("projective 128x1");
    EXPECT_GT(coarse["distance"]["mean"], 10 * fine["distance"]["mean"].get<double>());
    EXPECT_EQ(fine["interior"]["missed"], 0);
    EXPECT_EQ(fine["interior"]["extra"], 0);
    EXPECT_LT(fine["normal_angle"]["mean"], 1);
    // The tracer and Embree agree about the surface of a map.
    EXPECT_NEAR(chords("surface 128")["distance"]["mean"], fine["distance"]["mean"], 1e-6);
    const json& parts = find(methods, "method", "projective 128x1")["error_parts"];
    EXPECT_LT(parts["E_solver"], 1e-6);
    EXPECT_LT(parts["E_star"], parts["E_res"]);
    EXPECT_LE(parts["total"].get<double>(), parts["E_star"].get<double>() + parts["E_res"].get<double>() +
                                                parts["E_quant"].get<double>() + 1e-9);
    // Simplified meshes grow along the ladder, and come closer.
    double error = 1, bytes = 0;
    for (const json& method : methods) {
        if (method["family"] != "lod") continue;
        EXPECT_LT(method["sets"][0]["distance"]["mean"], error);
        EXPECT_GT(method["bytes"], bytes);
        error = method["sets"][0]["distance"]["mean"];
        bytes = method["bytes"];
    }
    EXPECT_EQ(find(report["bars"], "bar", "missed in the interior")["reached"], true);
    EXPECT_GT(find(methods, "method", "mesh")["build_seconds"], 0);
    EXPECT_GT(find(methods, "method", "projective 128x1")["file"]["first_ray"]["median"], 0);
}

TEST(BenchTraceVerb, TextFitsAReadmeAndPutsSilhouettesBesideRatios) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa(quick({}), folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const std::string& line : lines_of(outcome.out)) {
        // "±" is two bytes.
        const auto columns = std::count_if(line.begin(), line.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
        });
        EXPECT_LE(columns, 110) << line;
    }
    for (const char* const part : {"boot:2:", "smooth:2:", "chords rays", "E_quant", "silhouettes missed"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
}

TEST(BenchTraceVerb, WritesOneLineATiming) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_spa(quick({"--models", "cube", "--only", "projective,mesh", "--sets", "primary,shadow", "--csv",
                       "t.csv", "--sizes", "16", "--layers", "1"}),
                folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<std::string> lines = lines_of(read_file(folder.path() / "t.csv"));
    ASSERT_EQ(lines.size(), 1U + 2 * 2 * 2); // methods, sets, kinds
    EXPECT_TRUE(lines[0].starts_with("model,method,family,cells,layers,"));
    for (const std::string& line : lines)
        EXPECT_EQ(std::count(line.begin(), line.end(), ','),
                  std::count(lines[0].begin(), lines[0].end(), ','));
    EXPECT_TRUE(lines[1].starts_with("cube,projective 16x1,projective,16,1,")) << lines[1];
}

TEST(BenchTraceVerb, DrawsByGnuplot) {
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    const Outcome outcome =
        run_spa(quick({"--models", "smooth:2", "--sets", "chords", "--plots", "p"}), folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"p", "p/trace-smooth-2.gnuplot",
                                                        "p/trace-smooth-2.png", "p/trace.csv"}));
    const std::string png = read_file(folder.path() / "p/trace-smooth-2.png");
    EXPECT_TRUE(png.starts_with("\x89PNG"));
    EXPECT_GT(png.size(), 10000U);
}

TEST(BenchTraceVerb, SaysAtOnceThatGnuplotIsMissing) {
    const TemporaryFolder folder;
    const std::string path = std::getenv("PATH");
    ASSERT_EQ(setenv("PATH", "/nowhere", 1), 0);
    const Outcome outcome = run_spa(quick({"--plots", "p"}), folder.path());
    ASSERT_EQ(setenv("PATH", path.c_str(), 1), 0);
    EXPECT_EQ(outcome.exit_code, 5);
    EXPECT_NE(outcome.err.find("gnuplot-nox"), std::string::npos) << outcome.err;
    EXPECT_TRUE(folder.names().empty());
}

TEST(BenchTraceVerb, RefusesWhatItDoesNotKnow) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why,
                             int code = 1) {
        const Outcome outcome = run_spa(arguments, folder.path());
        EXPECT_EQ(outcome.exit_code, code);
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    };
    refused(quick({"--levels", "1"}), "--levels is not for 'spa bench trace'");
    refused(quick({"--only", "fans"}),
            "--only: 'fans' is not one of fan, march, projective, mesh, lod, surface");
    refused(quick({"--sets", "chord"}), "--sets: 'chord'");
    refused(quick({"--sizes", "33"}), "is odd");
    refused(quick({"--models", "boot:9"}), "--models");
    refused(quick({"--models", "nothing.glb"}), "nothing.glb", 2);
}

} // namespace
} // namespace spa::test
