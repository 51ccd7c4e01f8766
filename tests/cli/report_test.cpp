// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include "../../formats/container/reader.h"
#include "../../formats/container/writer.h"
#include "../../tools/report_page.h"
#include "../../tools/report_plan.h"

#include "../support/map_reports.h"

#include <gtest/gtest.h>

#include <sstream>

namespace spa::test {
namespace {

using nlohmann::json;
using Json = nlohmann::ordered_json;

class ReportVerb : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directory(path("maps"));
        run({"sample", "torus", "--level", "2", "-o", "maps/torus.glb"});
        run({"bake", "maps/torus.glb", "-o", "maps/torus.spa", "--size", "32"});
    }

    void run(const std::vector<std::string>& arguments) {
        const Outcome outcome = run_spa(arguments, folder_.path());
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    Outcome report(const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"report"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_spa(arguments, folder_.path());
    }
    // Of one that ends with `code`.
    json rows(std::vector<std::string> arguments, int code = 0) {
        arguments.insert(arguments.end(), {"--format", "json"});
        const Outcome outcome = report(arguments);
        EXPECT_EQ(outcome.exit_code, code) << outcome.err;
        json result = json::parse(outcome.out, nullptr, false);
        EXPECT_EQ(schema_error(load_schema("report"), result), "");
        return result;
    }
    // The map with other metadata.
    void rewrite(const std::string& from, const std::string& to,
                 const std::function<void(Json& metadata)>& change) {
        container::File file;
        ASSERT_TRUE(container::open(path(from).string(), file).ok());
        SphericalMap map = file.map();
        Json metadata = Json::parse(map.metadata);
        change(metadata);
        map.metadata = metadata.dump();
        ASSERT_TRUE(container::write(map, {}, path(to).string()).ok());
    }

    TemporaryFolder folder_;
};

TEST_F(ReportVerb, SaysOfAMapWhatOtherVerbsSay) {
    const json map = rows({"maps", "--rays", "3000"})["maps"][0];
    EXPECT_EQ(map["name"], "torus.spa");
    EXPECT_EQ(map["bytes"], read_file(path("maps/torus.spa")).size());
    EXPECT_EQ(map["shape"]["depth"]["size"], "32");
    EXPECT_EQ(map["source"]["matches"], true);
    EXPECT_EQ(map["settings"]["size"], "32");
    EXPECT_GT(map["speed"]["map"]["ns"], 0.0);
    EXPECT_GT(map["speed"]["triangles"]["ns"], 0.0);

    const Outcome outcome = run_spa({"inspect", "maps/torus.spa", "--format", "json"}, folder_.path());
    const json inspected = json::parse(outcome.out);
    std::map<std::string, std::uint64_t> stored, reported;
    for (const json& section : inspected["sections"])
        stored[section["type"]] += section["stored_bytes"].get<std::uint64_t>();
    for (const json& section : map["sections"])
        reported[section["type"]] += section["stored_bytes"].get<std::uint64_t>();
    EXPECT_EQ(reported, stored);

    // The map has no figures, so they are measured: with the rays that validate sends.
    const Outcome validated =
        run_spa({"validate", "maps/torus.spa", "--rays", "3000", "--format", "json"}, folder_.path());
    const json rays = json::parse(validated.out)["figures"]["rays"];
    EXPECT_EQ(map["errors"]["from"], "source");
    EXPECT_EQ(map["errors"]["false_hits"], rays["false_hits"]["share"]);
    EXPECT_EQ(map["errors"]["missed_hits"], rays["missed_hits"]["share"]);
    EXPECT_EQ(map["errors"]["mean_distance"], rays["distance"]["mean"]);
    EXPECT_GT(map["errors"]["mean_distance"], 0.0);
}

TEST_F(ReportVerb, TakesTheFiguresOfTheFile) {
    run({"bake", "maps/torus.glb", "-o", "maps/torus.spa", "--size", "32", "--measure"});
    const json map = rows({"maps/torus.spa", "--no-speed"})["maps"][0];
    container::File file;
    ASSERT_TRUE(container::open(path("maps/torus.spa").string(), file).ok());
    const json figures = json::parse(file.map().metadata)["figures"];
    EXPECT_EQ(map["errors"]["from"], "file");
    EXPECT_EQ(map["errors"]["hausdorff"], figures["hausdorff"]);
    EXPECT_EQ(map["errors"]["p95_distance"], figures["rays"]["distance"]["p95"]);
    EXPECT_EQ(map["errors"]["not_captured"], 1 - figures["captured_area"].get<double>());
    EXPECT_EQ(map["speed"], nullptr);
    // Without metadata the record of the part is what is left.
    rewrite("maps/torus.spa", "maps/bare.spa", [](Json& metadata) { metadata.clear(); });
    const json bare = rows({"maps/bare.spa", "--no-speed"})["maps"][0];
    EXPECT_EQ(bare["errors"]["false_hits"], nullptr);
    EXPECT_NEAR(bare["errors"]["hausdorff"].get<double>(), figures["hausdorff"].get<double>(), 1e-6);
    EXPECT_EQ(bare["source"], nullptr);
}

TEST_F(ReportVerb, FindsSourcesElsewhereAndOnlyTheRightOnes) {
    std::filesystem::create_directories(path("assets/sub"));
    std::filesystem::create_directories(path("maps/sub"));
    std::filesystem::rename(path("maps/torus.spa"), path("maps/sub/torus.spa"));
    std::filesystem::rename(path("maps/torus.glb"), path("assets/sub/torus.glb"));
    const json lost = rows({"maps", "--rays", "100"})["maps"][0];
    EXPECT_EQ(lost["source"]["path"], nullptr);
    EXPECT_EQ(lost["errors"], nullptr);
    EXPECT_EQ(lost["speed"]["triangles"], nullptr);
    const json found = rows({"maps", "--rays", "100", "--source", "assets"})["maps"][0];
    EXPECT_EQ(found["source"]["path"], "assets/sub/torus.glb");
    EXPECT_EQ(found["errors"]["from"], "source");

    run({"sample", "torus", "--level", "1", "-o", "assets/sub/torus.glb"});
    const json other = rows({"maps", "--rays", "100", "--source", "assets"})["maps"][0];
    EXPECT_EQ(other["source"]["matches"], false);
    EXPECT_EQ(other["errors"], nullptr);
    EXPECT_EQ(other["speed"]["triangles"], nullptr);
    EXPECT_EQ(other["warnings"].back(), "torus.glb is not what this was baked from");
}

TEST_F(ReportVerb, WithoutSpeedTheSameFilesGiveTheSamePage) {
    const json printed = rows({"maps", "--no-speed", "-o", "one.html"});
    rows({"maps", "--no-speed", "-o", "two.html"});
    const std::string page = read_file(path("one.html"));
    EXPECT_EQ(page, read_file(path("two.html")));
    const std::string data = "id=\"report\">";
    const std::size_t begin = page.find(data) + data.size();
    EXPECT_EQ(json::parse(page.substr(begin, page.find("</script", begin) - begin)), printed);
    EXPECT_NE(page.find("id=\"thumbnail-0\""), std::string::npos);
    EXPECT_NE(page.find("id=\"sheet-0\""), std::string::npos);
    rows({"maps", "--no-speed", "--no-sheets", "-o", "two.html"});
    EXPECT_EQ(read_file(path("two.html")).find("id=\"sheet-0\""), std::string::npos);
}

TEST_F(ReportVerb, AFileThatCannotBeReadIsARow) {
    std::string bytes = read_file(path("maps/torus.spa"));
    bytes.resize(bytes.size() / 2);
    write_file(path("maps/half.spa"), bytes);
    write_file(path("maps/PLAN.json"), R"({"objects": 7})");
    const json report = rows({"maps", "--no-speed", "-o", "page.html"}, 3);
    ASSERT_EQ(report["maps"].size(), 2U);
    EXPECT_EQ(report["maps"][0]["name"], "half.spa");
    EXPECT_TRUE(report["maps"][0]["error"].get<std::string>().starts_with("maps/half.spa: "));
    EXPECT_EQ(report["maps"][1]["error"], nullptr);
    EXPECT_EQ(report["plans"][0]["error"],
              "maps/PLAN.json: is not a plan: it has no list 'objects'; write it anew by 'spa plan'");
    EXPECT_TRUE(std::filesystem::exists(path("page.html")));
}

TEST_F(ReportVerb, SaysWhatIsWrongWithItsArguments) {
    EXPECT_EQ(report({}).exit_code, 1);
    const Outcome missing = report({"nowhere"});
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_NE(missing.err.find("nowhere: no such file or folder"), std::string::npos);
    std::filesystem::create_directory(path("empty"));
    EXPECT_EQ(report({"empty"}).exit_code, 2);
    EXPECT_EQ(report({"maps", "-o", "maps/torus.spa"}).exit_code, 1);
    EXPECT_EQ(report({"maps", "--rays", "3"}).exit_code, 1);
}

TEST_F(ReportVerb, TakesPlansAndSearches) {
    rewrite("maps/torus.spa", "maps/torus.spa", [](Json& metadata) {
        metadata["search"] = {
            {"target", 0.01},
            {"metric", "mean-dt"},
            {"max_bytes", nullptr},
            {"tried",
             {{{"settings", {{"size", 16}}}, {"bytes", 900}, {"error", 0.02}, {"met", false}},
              {{"settings", {{"size", 32}}}, {"bytes", 3000}, {"error", 0.007}, {"met", true}}}},
            {"chosen", 1},
            {"stopped_by", "target"}};
    });
    write_file(path("maps/PLAN.json"), R"({"scene": {"path": "room.glb", "triangles": 12}, "one_size": 64,
        "request": {"samples": 16, "camera": null}, "expected": {"bytes": 5000, "image_error": 0.01},
        "objects": [{"node": 3, "name": "boot", "decision": "map", "settings": {"size": "32", "layers": 2},
                     "views": {"ray_share": 0.5}, "expected": {"bytes": 5000}, "why": "because"}, 17]})");
    const json report = rows({"maps", "--no-speed"});
    const json& search = report["maps"][0]["search"];
    EXPECT_EQ(search["chosen"], 1);
    EXPECT_EQ(search["candidates"][1]["settings"]["size"], "32");
    EXPECT_EQ(search["candidates"][0]["met"], false);
    const json& plan = report["plans"][0];
    EXPECT_EQ(plan["scene"], "room.glb");
    EXPECT_EQ(plan["one_size"], 64);
    ASSERT_EQ(plan["objects"].size(), 2U);
    EXPECT_EQ(plan["objects"][0]["settings"], json({{"size", "32"}, {"layers", "2"}}));
    EXPECT_EQ(plan["objects"][0]["ray_share"], 0.5);
    EXPECT_EQ(plan["objects"][0]["why"], "because");
    EXPECT_EQ(plan["objects"][1]["decision"], nullptr);
    const Outcome text = this->report({"maps", "--no-speed"});
    EXPECT_NE(text.out.find("PLAN.json: 2 objects, 1 map, 1 undecided\n"), std::string::npos) << text.out;
}

TEST(ReportPlan, NonsenseOfStrangersIsNull) {
    EXPECT_EQ(tools::search_json(Json::parse(R"({"search": 7})")), nullptr);
    Json search = Json::parse(R"({"target": -1, "metric": 4, "max_bytes": "many", "stopped_by": [],
        "chosen": 5, "tried": [3, {"settings": {"size": [1], "layers": true}, "bytes": -2, "error": {}, "met": 1}]})");
    Json found = tools::search_json({{"search", search}});
    for (const char* key : {"target", "metric", "max_bytes", "stopped_by", "chosen"})
        EXPECT_EQ(found[key], nullptr) << key;
    ASSERT_EQ(found["candidates"].size(), 2U);
    EXPECT_EQ(found["candidates"][1]["settings"], Json({{"layers", "true"}}));
    EXPECT_EQ(found["candidates"][1]["bytes"], nullptr);
    EXPECT_EQ(found["candidates"][1]["met"], nullptr);
    search["tried"] = Json::array();
    for (int i = 0; i < 5000; ++i) search["tried"].push_back({{"bytes", i}});
    search["metric"] = std::string(100'000, 'x');
    found = tools::search_json({{"search", search}});
    EXPECT_EQ(found["candidates"].size(), 1000U);
    EXPECT_LT(found["metric"].get<std::string>().size(), 100U);
}

TEST(ReportPlan, TextIsCutBetweenCharacters) {
    EXPECT_EQ(tools::cut_text("abc", 3), "abc");
    EXPECT_EQ(tools::cut_text("ab\u00e4", 3), "ab\u2026");
    EXPECT_EQ(tools::cut_text("ab\u00e4", 4), "ab\u00e4");
}

TEST(ReportPage, ReportsOfTheTestsKeepTheSchema) {
    for (const Json& report : {hostile_map_report(), large_map_report(3)})
        EXPECT_EQ(schema_error(load_schema("report"),
                               json::parse(report.dump(-1, ' ', false, Json::error_handler_t::replace))),
                  "");
}

TEST(ReportPage, MayLoadNothingAndNoTextEndsItsScript) {
    const auto page_of = [](const Json& report) {
        std::ostringstream out;
        tools::write_report_page(out, report, {});
        return out.str();
    };
    const auto scripts = [](const std::string& page) {
        std::size_t count = 0;
        for (std::size_t at = page.find("<script"); at != std::string::npos;
             at = page.find("<script", at + 1))
            ++count;
        return count;
    };
    const std::string page = page_of(hostile_map_report());
    EXPECT_EQ(scripts(page), scripts(page_of(large_map_report(0))));
    EXPECT_EQ(page.find('\xFF'), std::string::npos);
    EXPECT_NE(page.find("content=\"default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; "
                        "style-src 'sha256-"),
              std::string::npos);
    EXPECT_LT(page.find("Content-Security-Policy"), page.find("<style>"));
    for (const char* address : {"url(", "@import", "href=", "sourceMappingURL"})
        EXPECT_EQ(page.find(address), std::string::npos) << address;
}

} // namespace
} // namespace spa::test
