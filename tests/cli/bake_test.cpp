// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include "../../formats/container/reader.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using nlohmann::json;

// A folder with a small boot in it.
class BakeVerb : public testing::Test {
protected:
    void SetUp() override {
        const Outcome outcome = run_spa({"sample", "boot", "--level", "1", "-o", "boot.glb"}, folder_.path());
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }

    // Bakes boot.glb into `output`; returns the JSON report.
    json bake(const std::string& output, std::vector<std::string> options = {}) {
        std::vector<std::string> arguments{"bake", "boot.glb", "-o", output, "--format", "json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = run_spa(arguments, folder_.path());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return json::parse(outcome.out);
    }
    [[nodiscard]] std::string file(const std::string& name) const { return read_file(folder_.path() / name); }
    [[nodiscard]] container::File open(const std::string& name) const {
        container::File opened;
        EXPECT_TRUE(container::open((folder_.path() / name).string(), opened).ok());
        return opened;
    }

    TemporaryFolder folder_;
};

TEST_F(BakeVerb, ReportFollowsItsSchema) {
    const json report = bake("boot.spa", {"--size", "32"});
    EXPECT_EQ(schema_error(load_schema("bake"), report), "");
    EXPECT_EQ(report["source"]["name"], "boot.glb");
    EXPECT_EQ(report["source"]["format"], "GLB");
    EXPECT_EQ(report["source"]["bytes"], file("boot.glb").size());
    EXPECT_EQ(report["source"]["vertices"], 1317);
    EXPECT_EQ(report["report"]["triangles"], 4 * 650);
    EXPECT_EQ(report["output"]["path"], "boot.spa");
    EXPECT_EQ(report["output"]["bytes"], file("boot.spa").size());
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"boot.glb", "boot.spa"}));
}

TEST_F(BakeVerb, DefaultsAreTheDocumentedOnes) {
    const json expected = {
        {"mapping", "octahedral"}, {"size", "256"},     {"color_size", "256"}, {"depth", "u16"},
        {"normals", "oct16"},      {"layers", 2},       {"folds", "on"},       {"frame", "auto"},
        {"center", "auto"},        {"baker", "radial"}, {"gl", "auto"},        {"samples", 1},
        {"compress", "zstd"},      {"measure", false},  {"parts", "whole"},    {"max_parts", 64}};
    EXPECT_EQ(bake("boot.spa")["options"], expected);
    const container::File opened = open("boot.spa");
    const Surface& outer = opened.map().parts.at(0).layers.at(0).outer;
    EXPECT_EQ(outer.depth.width, 257U);
    EXPECT_EQ(outer.depth.height, 257U);
    EXPECT_EQ(outer.color.width, 257U);
    EXPECT_EQ(outer.depth.format, ElementFormat::u16);
    EXPECT_EQ(outer.normal.format, ElementFormat::oct16);
}

TEST_F(BakeVerb, OptionsReachTheFile) {
    const json report = bake("boot.spa", {"--mapping", "latlong",   "--size",  "64",         "--color-size",
                                          "100x50",    "--depth",   "f32",     "--normals",  "oct8",
                                          "--layers",  "1",         "--frame", "affine",     "--center",
                                          "captured",  "--samples", "2",       "--compress", "none"});
    EXPECT_EQ(report["options"]["size"], "64x32");
    EXPECT_EQ(report["options"]["color_size"], "100x50");
    const container::File opened = open("boot.spa");
    const Part& part = opened.map().parts.at(0);
    ASSERT_EQ(part.layers.size(), 1U);
    const Surface& outer = part.layers[0].outer;
    EXPECT_EQ(part.mapping, Mapping::latlong);
    EXPECT_FALSE(part.frame == Mat3{});
    EXPECT_EQ(outer.depth.width, 64U);
    EXPECT_EQ(outer.depth.height, 32U);
    EXPECT_EQ(outer.depth.format, ElementFormat::f32);
    EXPECT_EQ(outer.normal.format, ElementFormat::oct8);
    EXPECT_EQ(outer.color.width, 100U);
    EXPECT_EQ(outer.color.height, 50U);
    for (const container::SectionEntry& section : opened.sections())
        EXPECT_EQ(section.scheme, container::Scheme::none);
}

TEST_F(BakeVerb, PaperIsAPresetWhoseOptionsCanBeChanged) {
    const json options = bake("boot.spa", {"--paper", "--samples", "1"})["options"];
    EXPECT_EQ(options["mapping"], "latlong");
    EXPECT_EQ(options["size"], "640x480");
    EXPECT_EQ(options["depth"], "u8");
    EXPECT_EQ(options["normals"], "rgb8");
    EXPECT_EQ(options["layers"], 1);
    const json changed = bake("boot.spa", {"--depth", "u16", "--paper", "--size", "64x48"})["options"];
    EXPECT_EQ(changed["depth"], "u16");
    EXPECT_EQ(changed["size"], "64x48");
    EXPECT_EQ(changed["normals"], "rgb8");
    const json octahedral = bake("boot.spa", {"--paper", "--mapping", "octahedral"})["options"];
    EXPECT_EQ(octahedral["size"], "256");
    EXPECT_EQ(octahedral["depth"], "u8");
}

TEST_F(BakeVerb, SameBytesForAnyNumberOfThreads) {
    bake("one.spa", {"--threads", "1", "--size", "128", "--samples", "2"});
    bake("two.spa", {"--threads", "2", "--size", "128", "--samples", "2"});
    bake("five.spa", {"--threads", "5", "--size", "128", "--samples", "2"});
    EXPECT_EQ(file("one.spa"), file("two.spa"));
    EXPECT_EQ(file("one.spa"), file("five.spa"));
}

TEST_F(BakeVerb, SameBytesWhereverTheInputLies) {
    bake("here.spa", {"--size", "32"});
    const TemporaryFolder elsewhere;
    write_file(elsewhere.path() / "boot.glb", file("boot.glb"));
    const Outcome outcome = run_spa(
        {"bake", (elsewhere.path() / "boot.glb").string(), "-o", "there.spa", "--size", "32", "--quiet"},
        folder_.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(file("here.spa"), file("there.spa"));
}

TEST_F(BakeVerb, MetadataSaysWhereTheMapComesFrom) {
    const json report = bake("boot.spa", {"--size", "32"});
    const json metadata = json::parse(open("boot.spa").map().metadata);
    EXPECT_EQ(metadata["generator"]["name"], "spa");
    EXPECT_EQ(metadata["generator"]["version"], SPA_VERSION);
    EXPECT_EQ(metadata["source"], report["source"]);
    EXPECT_EQ(metadata["options"], report["options"]);
    EXPECT_EQ(metadata["report"]["layers"], report["report"]["layers"]);
    EXPECT_EQ(metadata["units"], "object");
    EXPECT_FALSE(metadata.contains("seconds"));
    EXPECT_EQ(metadata.dump().find(folder_.path().string()), std::string::npos);
}

TEST_F(BakeVerb, TextReportIsShortAndOnStdout) {
    const Outcome outcome = run_spa({"bake", "boot.glb", "-o", "boot.spa", "--size", "32"}, folder_.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("boot.spa\nsource    boot.glb, GLB, 1317 vertices, 2600 triangles\n", 0), 0U)
        << outcome.out;
}

TEST_F(BakeVerb, MissingAssetIsAnInputError) {
    const Outcome outcome = run_spa({"bake", "none.glb", "-o", "out.spa"}, folder_.path());
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err.rfind("spa: none.glb: ", 0), 0U) << outcome.err;
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"boot.glb"});
}

TEST_F(BakeVerb, GarbageIsInvalidData) {
    write_file(folder_.path() / "garbage.glb", "glTF but not really");
    write_file(folder_.path() / "garbage", "nothing known");
    for (const char* name : {"garbage.glb", "garbage"}) {
        const Outcome outcome = run_spa({"bake", name, "-o", "out.spa"}, folder_.path());
        EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
        EXPECT_EQ(outcome.err.rfind(std::string("spa: ") + name + ": ", 0), 0U) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.spa"));
    }
}

TEST_F(BakeVerb, TextureOfTheAssetIsNotOverwritten) {
    write_file(folder_.path() / "a.mtl", "newmtl m\nKd 1 0 0\n");
    write_file(folder_.path() / "a.obj", "mtllib a.mtl\nusemtl m\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
    const Outcome outcome = run_spa({"bake", "a.obj", "-o", "a.mtl"}, folder_.path());
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("both input and output"), std::string::npos) << outcome.err;
    EXPECT_EQ(file("a.mtl"), "newmtl m\nKd 1 0 0\n");
}

} // namespace
} // namespace spa::test
