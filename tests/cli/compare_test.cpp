// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using nlohmann::json;

class CompareVerb : public testing::Test {
protected:
    void SetUp() override {
        run({"sample", "boot", "--level", "0", "-o", "boot.glb"});
        run({"bake", "boot.glb", "-o", "a.spa", "--size", "32"});
        run({"bake", "boot.glb", "-o", "coarse.spa", "--size", "32", "--depth", "u8", "--normals", "oct8"});
        run({"bake", "boot.glb", "-o", "small.spa", "--size", "16"});
    }
    Outcome run(const std::vector<std::string>& arguments) { return run_spa(arguments, folder_.path()); }
    [[nodiscard]] bool exists(const std::string& name) const {
        return std::filesystem::exists(folder_.path() / name);
    }

    TemporaryFolder folder_;
};

TEST_F(CompareVerb, EqualFilesMatch) {
    const Outcome outcome = run({"compare", "a.spa", "a.spa", "--format", "json", "--sheet", "d.png"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("compare"), report), "");
    EXPECT_EQ(report["result"], "match");
    for (const json& figure : report["figures"]) EXPECT_EQ(figure, 0);
    EXPECT_FALSE(exists("d.png")) << "only a difference is worth a picture";
}

TEST_F(CompareVerb, AnyDifferenceFailsByDefault) {
    const Outcome outcome = run({"compare", "a.spa", "coarse.spa", "--format", "json", "--sheet", "d.png"});
    EXPECT_EQ(outcome.exit_code, 6);
    EXPECT_NE(outcome.err.find("a.spa and coarse.spa differ: "), std::string::npos) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("compare"), report), "");
    EXPECT_EQ(report["result"], "fail");
    EXPECT_EQ(report["figures"]["coverage"], 0);
    EXPECT_NEAR(report["figures"]["depth_max"].get<double>(), 0.5 / 255, 0.1 / 255);
    EXPECT_TRUE(exists("d.png"));
}

TEST_F(CompareVerb, OnlyWhatIsNamedIsJudged) {
    EXPECT_EQ(run({"compare", "a.spa", "coarse.spa", "--fail", "coverage=0,depth_max=0.01"}).exit_code, 0);
    const Outcome failed = run({"compare", "a.spa", "coarse.spa", "--fail", "coverage=0,depth_max=1e-6"});
    EXPECT_EQ(failed.exit_code, 6);
    EXPECT_NE(failed.err.find("depth_max"), std::string::npos);
    const Outcome warned =
        run({"compare", "a.spa", "coarse.spa", "--warn", "depth_max=1e-6", "--format", "json"});
    EXPECT_EQ(warned.exit_code, 0);
    EXPECT_NE(warned.err.find("spa: warning: depth_max"), std::string::npos);
    EXPECT_EQ(json::parse(warned.out)["result"], "warn");
}

TEST_F(CompareVerb, OtherSizesCannotBeCompared) {
    const Outcome outcome = run({"compare", "a.spa", "small.spa", "--format", "json", "--warn", "radius=1"});
    EXPECT_EQ(outcome.exit_code, 6);
    EXPECT_NE(outcome.err.find("differ in size"), std::string::npos);
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("compare"), report), "");
    EXPECT_EQ(report["comparable"], false);
}

TEST_F(CompareVerb, ASurfaceThatOneMapLacksCanBeDrawn) {
    // The boot's kernel would see all of it in one layer.
    const auto bake = [&](const char* name, const char* layers) {
        run({"bake", "boot.glb", "-o", name, "--size", "32", "--layers", layers, "--center", "bounds",
             "--frame", "sphere"});
    };
    bake("one.spa", "1");
    bake("two.spa", "2");
    for (const auto& [first, second] : {std::pair{"one.spa", "two.spa"}, {"two.spa", "one.spa"}}) {
        const Outcome outcome = run({"compare", first, second, "--sheet", "d.png"});
        EXPECT_EQ(outcome.exit_code, 6) << outcome.signal;
        EXPECT_TRUE(exists("d.png"));
        std::filesystem::remove(folder_.path() / "d.png");
    }
}

TEST_F(CompareVerb, StandardInputHoldsOneFile) { EXPECT_EQ(run({"compare", "-", "-"}).exit_code, 1); }

TEST_F(CompareVerb, WrongLimitsAreUsageErrors) {
    for (const char* const limit :
         {"depth=1", "depth_max", "depth_max=", "depth_max=x", "depth_max=-1", "", "depth_max=1,"}) {
        const Outcome outcome = run({"compare", "a.spa", "a.spa", "--fail", limit});
        EXPECT_EQ(outcome.exit_code, 1) << limit;
        EXPECT_NE(outcome.err.find("--fail"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run({"compare", "a.spa"}).exit_code, 1);
    EXPECT_EQ(run({"compare", "a.spa", "none.spa"}).exit_code, 2);
}

} // namespace
} // namespace spa::test
