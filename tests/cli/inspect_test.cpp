// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include "../../formats/container/reader.h"
#include "../../formats/container/writer.h"
#include "../../libspa/core/folds.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace spa::test {
namespace {

using nlohmann::json;

class InspectVerb : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(run_spa({"sample", "torus", "--level", "2", "-o", "torus.glb"}, folder_.path()).exit_code,
                  0);
        ASSERT_EQ(run_spa({"bake", "torus.glb", "-o", "torus.spa", "--size", "64", "--center", "bounds",
                           "--frame", "sphere"},
                          folder_.path())
                      .exit_code,
                  0);
    }

    Outcome inspect(const std::vector<std::string>& more, const std::string& input = "") {
        std::vector<std::string> arguments{"inspect"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_spa(arguments, folder_.path(), input);
    }
    [[nodiscard]] std::string file(const std::string& name) const { return read_file(folder_.path() / name); }

    TemporaryFolder folder_;
};

TEST_F(InspectVerb, JsonFollowsItsSchemaAndAddsUp) {
    const Outcome outcome = inspect({"torus.spa", "--format", "json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("inspect"), report), "");
    EXPECT_EQ(report["bytes"], file("torus.spa").size());
    EXPECT_EQ(report["parts"][0]["size"], "64");
    EXPECT_EQ(report["parts"][0]["center_inside"], false);
    EXPECT_EQ(report["parts"][0]["mixed_triangles"], report["metadata"]["report"]["mixed_triangles"]);
    const json& sections = report["sections"];
    EXPECT_EQ(sections[sections.size() - 2]["type"], "MIXD");
    EXPECT_EQ(sections[sections.size() - 2]["part"], 0);
    EXPECT_EQ(sections.back()["type"], "FOLD");
    EXPECT_EQ(report["parts"][0]["fold_records"].get<std::uint64_t>() * 10, sections.back()["raw_bytes"]);
    std::uint64_t raw = 0;
    for (const json& section : sections) raw += section["raw_bytes"].get<std::uint64_t>();
    EXPECT_EQ(report["raw_bytes"], raw);
    EXPECT_EQ(report["metadata"]["options"]["size"], "64");
}

TEST_F(InspectVerb, FoldRecordsAreCounted) {
    const std::string bytes = file("torus.spa");
    container::File opened;
    ASSERT_TRUE(container::open(std::as_bytes(std::span(bytes)), opened).ok());
    SphericalMap map = opened.map();
    map.parts[0].folds = {};
    const auto write = [&](const char* name) {
        std::vector<std::byte> out;
        const container::Status status = container::write(map, {}, out);
        EXPECT_TRUE(status.ok()) << container::describe(status, name);
        write_file(folder_.path() / name, {reinterpret_cast<const char*>(out.data()), out.size()});
    };
    write("plain.spa");
    EXPECT_EQ(json::parse(inspect({"plain.spa", "--format", "json"}).out)["parts"][0]["fold_records"],
              nullptr);
    EXPECT_EQ(inspect({"plain.spa"}).out.find("  folds"), std::string::npos);

    // The middle of the map looks at the tube.
    const std::vector<std::byte> mixed(map.parts[0].mixed.size(), std::byte{0xFF});
    const std::uint32_t edge = edge_number(64, {32, 32}, 0);
    const std::vector<std::byte> folds =
        encode_folds(std::vector<FoldRecord>{{edge, true, 0, 0, 99, {40000, 40000}},
                                             {edge + 1, false, 0, 1, 3, {40000, 0}},
                                             {edge + 1, false, 0, 0, 3, {1, 0}}});
    map.parts[0].mixed = mixed;
    map.parts[0].folds = folds;
    write("folds.spa");
    const json report = json::parse(inspect({"folds.spa", "--format", "json"}).out);
    EXPECT_EQ(schema_error(load_schema("inspect"), report), "");
    EXPECT_EQ(report["parts"][0]["fold_records"], 3);
    EXPECT_EQ(report["sections"].back()["type"], "FOLD");
    EXPECT_EQ(report["sections"].back()["part"], 0);
    EXPECT_EQ(report["sections"].back()["raw_bytes"], 30);
    const std::string text = inspect({"folds.spa"}).out;
    EXPECT_NE(text.find("\n  folds     3 records"), std::string::npos) << text;
    EXPECT_NE(text.find("\n  FOLD  part 0  "), std::string::npos) << text;
}

// Radii 1 and 0.4 about the Y axis: seen from the centre the tube reaches up to asin(0.4) from the equator,
// so the share of directions that meet it is 0.4; where it does, it begins at 0.6 and ends at 1.4, of a
// radius of sqrt(1.4^2 + 1.4^2 + 0.4^2) or less.
TEST_F(InspectVerb, CoverageAndDepthAreThoseOfATorus) {
    const json part = json::parse(inspect({"torus.spa", "--format", "json"}).out)["parts"][0];
    const json& outer = part["layers"][0]["outer"];
    EXPECT_NEAR(outer["coverage"].get<double>(), 0.4, 0.01);
    const double radius = part["radius"].get<double>();
    EXPECT_NEAR(outer["depth_max"].get<double>() * radius, 1.4, 0.01);
    EXPECT_NEAR(part["layers"][0]["inner"]["depth_min"].get<double>() * radius, 0.6, 0.01);
    double sum = 0;
    for (const json& bin : outer["depth_histogram"]) sum += bin.get<double>();
    EXPECT_NEAR(sum, outer["coverage"].get<double>(), 1e-9);
    const auto lowest_bin = std::size_t(outer["depth_min"].get<double>() * 32);
    for (std::size_t i = 0; i < lowest_bin; ++i) EXPECT_EQ(outer["depth_histogram"][i], 0) << i;
    EXPECT_GT(outer["depth_histogram"][lowest_bin], 0);
}

TEST_F(InspectVerb, TextNamesEverySection) {
    const Outcome outcome = inspect({"torus.spa"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("torus.spa: spherical map, version 1.3, 1 part, ", 0), 0U) << outcome.out;
    for (const char* text :
         {"PART", "META", "DPTH", "NRML", "COLR", "MIXD", "FOLD", "octahedral 64, 65x65 samples",
          "not measured", "source.name", "torus.glb", "coverage"})
        EXPECT_NE(outcome.out.find(text), std::string::npos) << text;
}

TEST_F(InspectVerb, StandardInputSaysTheSame) {
    json from_file = json::parse(inspect({"torus.spa", "--format", "json"}).out);
    const Outcome streamed = inspect({"-", "--format", "json"}, file("torus.spa"));
    ASSERT_EQ(streamed.exit_code, 0) << streamed.err;
    json from_stream = json::parse(streamed.out);
    EXPECT_EQ(from_stream["file"], "-");
    from_stream["file"] = from_file["file"];
    EXPECT_EQ(from_stream, from_file);
}

TEST_F(InspectVerb, DamagedFilesEndWithThreeAndASentence) {
    const std::string good = file("torus.spa");
    std::string flipped = good;
    flipped[good.size() / 2] = char(~flipped[good.size() / 2]);
    const std::pair<const char*, std::string> cases[] = {
        {"flipped", flipped},         {"short", good.substr(0, good.size() - 100)},
        {"long", good + "x"},         {"empty", ""},
        {"head", good.substr(0, 20)}, {"other", "hello, world, this is text"},
    };
    for (const auto& [name, bytes] : cases) {
        write_file(folder_.path() / name, bytes);
        for (const bool streamed : {false, true}) {
            const Outcome outcome = streamed ? inspect({"-"}, bytes) : inspect({name});
            EXPECT_EQ(outcome.exit_code, 3) << name << outcome.err;
            EXPECT_EQ(outcome.out, "") << name;
            EXPECT_EQ(outcome.err.rfind(streamed ? "spa: standard input" : "spa: " + std::string(name), 0),
                      0U)
                << outcome.err;
            EXPECT_NE(outcome.err.find("SPA-"), std::string::npos) << outcome.err;
        }
    }
}

TEST_F(InspectVerb, MissingFileIsAnInputError) {
    const Outcome outcome = inspect({"none.spa"});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("none.spa"), std::string::npos);
}

TEST_F(InspectVerb, SheetIsAPictureOfReasonableSizeAndAlwaysTheSame) {
    ASSERT_EQ(inspect({"torus.spa", "--sheet", "a.png"}).exit_code, 0);
    ASSERT_EQ(inspect({"torus.spa", "--sheet", "b.png"}).exit_code, 0);
    EXPECT_EQ(file("a.png"), file("b.png"));
    const auto image = OIIO::ImageInput::open((folder_.path() / "a.png").string());
    ASSERT_TRUE(image);
    EXPECT_GT(image->spec().width, 800);
    EXPECT_LE(image->spec().width, 1600);
    EXPECT_EQ(image->spec().nchannels, 3);
    std::vector<std::uint8_t> pixels(image->spec().image_pixels() * 3);
    ASSERT_TRUE(image->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
    // More than the background: the lightest (coverage, text) and the darkest (no surface) are there.
    EXPECT_EQ(*std::max_element(pixels.begin(), pixels.end()), 255);
    EXPECT_EQ(*std::min_element(pixels.begin(), pixels.end()), 0);
}

TEST_F(InspectVerb, DamagedFileMakesNoSheet) {
    write_file(folder_.path() / "bad.spa", "no");
    EXPECT_EQ(inspect({"bad.spa", "--sheet", "bad.png"}).exit_code, 3);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "bad.png"));
}

} // namespace
} // namespace spa::test
