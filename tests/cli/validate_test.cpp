// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "schema.h"

#include "../../formats/container/reader.h"
#include "../../formats/container/writer.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

namespace spa::test {
namespace {

using nlohmann::json;

class ValidateVerb : public testing::Test {
protected:
    void SetUp() override {
        run({"sample", "torus", "--level", "1", "-o", "torus.glb"});
        run({"bake", "torus.glb", "-o", "torus.spa", "--size", "32", "--layers", "1"});
    }

    Outcome run(const std::vector<std::string>& arguments) { return run_spa(arguments, folder_.path()); }
    Outcome validate(const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"validate"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    // The map with its first depths taken away, and the metadata it had.
    void write_with_hole(const std::string& name) {
        const std::string bytes = read_file(folder_.path() / "torus.spa");
        container::File file;
        ASSERT_TRUE(container::open(std::as_bytes(std::span(bytes)), file).ok());
        SphericalMap map = file.map();
        ImageView& depth = map.parts[0].layers[0].outer.depth;
        std::vector<std::byte> changed(depth.bytes.begin(), depth.bytes.end());
        for (std::size_t i = 2 * (16 * 33 + 4); i < 2 * (16 * 33 + 8); ++i) changed[i] = std::byte{0};
        depth.bytes = changed;
        map.parts[0].mixed = map.parts[0].folds = {}; // they know nothing of the hole
        std::vector<std::byte> out;
        ASSERT_TRUE(container::write(map, {}, out).ok());
        write_file(folder_.path() / name, {reinterpret_cast<const char*>(out.data()), out.size()});
    }

    TemporaryFolder folder_;
};

TEST_F(ValidateVerb, IsSilentWhenAllIsWell) {
    const Outcome outcome = validate({"torus.spa"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
}

TEST_F(ValidateVerb, JsonFollowsItsSchema) {
    const Outcome outcome = validate({"torus.spa", "--format", "json", "--max-normal", "5"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("validate"), report), "");
    EXPECT_EQ(report["source"]["path"], "torus.glb");
    EXPECT_EQ(report["source"]["matches"], true);
    EXPECT_TRUE(report["figures"]["quantization"]["holds"]);
    EXPECT_LT(report["figures"]["captured_area"], 0.8);
    EXPECT_EQ(report["thresholds"][0]["met"], true);
    EXPECT_EQ(report["findings"], json::array());
}

TEST_F(ValidateVerb, EveryThresholdIsJudged) {
    for (const auto& [option, met, missed] : {std::tuple{"--max-texel-distance", "1e-3", "1e-9"},
                                              {"--max-surface-distance", "1", "1e-3"},
                                              {"--max-normal", "1", "0"},
                                              {"--min-captured", "0.5", "0.9"},
                                              {"--min-captured", "0", "1"}}) {
        EXPECT_EQ(validate({"torus.spa", option, met}).exit_code, 0) << option;
        const Outcome outcome = validate({"torus.spa", option, missed});
        EXPECT_EQ(outcome.exit_code, 6) << option;
        EXPECT_NE(outcome.err.find(std::string("torus.spa: ") + option), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(validate({"torus.spa", "--max-color", "0"}).exit_code, 0);
    EXPECT_EQ(validate({"torus.spa", "--max-color", "-1"}).exit_code, 1);
    EXPECT_EQ(validate({"torus.spa", "--max-normal", "nan"}).exit_code, 1);
    EXPECT_EQ(validate({"torus.spa", "--min-coverage", "1"}).exit_code, 0);
    EXPECT_EQ(validate({"torus.spa", "--min-coverage", "1.1"}).exit_code, 1);
    EXPECT_EQ(validate({"torus.spa", "--heat", ""}).exit_code, 1);
    EXPECT_EQ(validate({"torus.spa", "--heat", "torus.glb"}).exit_code, 1) << "the source, found beside it";
}

// One layer fills the hole of a torus; two keep it open.
TEST_F(ValidateVerb, RaysFindTheHoleOfATorusFilled) {
    const json report = json::parse(validate({"torus.spa", "--rays", "6000", "--format", "json"}).out);
    EXPECT_EQ(schema_error(load_schema("validate"), report), "");
    const json& rays = report["figures"]["rays"];
    EXPECT_EQ(rays["count"], 6000);
    EXPECT_GT(rays["false_hits"]["share"], 0.02);
    const double all =
        rays["false_hits"]["band"].get<double>() + rays["false_hits"]["interior"].get<double>();
    EXPECT_GT(rays["false_hits"]["star"], 0.8 * all);
    EXPECT_NE(validate({"torus.spa", "--rays", "6000", "--format", "text"}).out.find("false hits"),
              std::string::npos);
    const Outcome failed = validate({"torus.spa", "--rays", "6000", "--max-false-hits", "0.01"});
    EXPECT_EQ(failed.exit_code, 6);
    EXPECT_NE(failed.err.find("torus.spa: --max-false-hits 0.01 is exceeded: "), std::string::npos)
        << failed.err;
    ASSERT_EQ(run({"bake", "torus.glb", "-o", "two.spa", "--size", "64"}).exit_code, 0);
    const Outcome met =
        validate({"two.spa", "--rays", "6000", "--max-false-hits", "0.01", "--max-missed-hits", "0.01"});
    EXPECT_EQ(met.exit_code, 0) << met.err;
    ASSERT_EQ(
        run({"bake", "torus.glb", "-o", "latlong.spa", "--mapping", "latlong", "--size", "64x48"}).exit_code,
        0);
    EXPECT_EQ(validate({"latlong.spa", "--rays", "10"}).exit_code, 5);
    EXPECT_EQ(validate({"torus.spa", "--rays", "0"}).exit_code, 1);
    EXPECT_EQ(validate({"torus.spa", "--max-false-hits", "2"}).exit_code, 1);
}

TEST_F(ValidateVerb, ADefectIsNamed) {
    write_with_hole("hole.spa");
    const Outcome outcome = validate({"hole.spa"});
    EXPECT_EQ(outcome.exit_code, 6);
    EXPECT_NE(
        outcome.err.find("4 texels have no surface where the source has one; the first is layer 0 outer, "
                         "texel (4, 16)"),
        std::string::npos)
        << outcome.err;
    const json report = json::parse(validate({"hole.spa", "--format", "json"}).out);
    EXPECT_EQ(schema_error(load_schema("validate"), report), "");
    EXPECT_EQ(report["findings"][0]["kind"], "missing");
    EXPECT_EQ(report["figures"]["coverage"]["missing"], 4);
}

TEST_F(ValidateVerb, WithoutASourceOnlyTheContainerIsChecked) {
    std::filesystem::rename(folder_.path() / "torus.glb", folder_.path() / "elsewhere.glb");
    EXPECT_EQ(validate({"torus.spa"}).exit_code, 0);
    const json report = json::parse(validate({"torus.spa", "--format", "json"}).out);
    EXPECT_EQ(schema_error(load_schema("validate"), report), "");
    EXPECT_EQ(report["source"], nullptr);
    EXPECT_EQ(report["figures"], nullptr);
    const Outcome outcome = validate({"torus.spa", "--min-captured", "0"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("--source"), std::string::npos) << outcome.err;
    EXPECT_EQ(validate({"torus.spa", "--source", "elsewhere.glb", "--min-captured", "0"}).err, "");
}

TEST_F(ValidateVerb, AnotherSourceIsSaid) {
    run({"sample", "torus", "--level", "2", "-o", "torus.glb"});
    const Outcome outcome = validate({"torus.spa", "--format", "json"});
    EXPECT_NE(outcome.err.find("torus.glb is not what torus.spa was baked from"), std::string::npos)
        << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(report["source"]["matches"], false);
    EXPECT_EQ(report["source"]["differing"], json::array({"torus.glb"}));
}

TEST_F(ValidateVerb, ANameWithAFolderIsNotFollowed) {
    const std::string bytes = read_file(folder_.path() / "torus.spa");
    container::File file;
    ASSERT_TRUE(container::open(std::as_bytes(std::span(bytes)), file).ok());
    SphericalMap map = file.map();
    map.metadata = R"({"source":{"name":"../torus.glb"}})";
    std::vector<std::byte> out;
    ASSERT_TRUE(container::write(map, {}, out).ok());
    std::filesystem::create_directory(folder_.path() / "inside");
    write_file(folder_.path() / "inside/map.spa", {reinterpret_cast<const char*>(out.data()), out.size()});
    const json report = json::parse(validate({"inside/map.spa", "--format", "json"}).out);
    EXPECT_EQ(report["source"], nullptr);
}

TEST_F(ValidateVerb, DrawsAPicture) {
    EXPECT_EQ(validate({"torus.spa", "--heat", "heat.png"}).exit_code, 0);
    const auto picture = OIIO::ImageInput::open((folder_.path() / "heat.png").string());
    ASSERT_NE(picture, nullptr);
    EXPECT_GT(picture->spec().width, 600);
    EXPECT_EQ(validate({"torus.spa", "--heat", "missing/heat.png"}).exit_code, 2);
    EXPECT_EQ(validate({"torus.spa", "--heat", "torus.spa"}).exit_code, 1);
}

TEST_F(ValidateVerb, ADamagedFileIsInvalid) {
    std::string bytes = read_file(folder_.path() / "torus.spa");
    bytes[bytes.size() / 2] ^= 1;
    write_file(folder_.path() / "torus.spa", bytes);
    EXPECT_EQ(validate({"torus.spa"}).exit_code, 3);
}

TEST_F(ValidateVerb, BakeWritesTheSameFigures) {
    const Outcome baked = run({"bake", "torus.glb", "-o", "m.spa", "--size", "32", "--layers", "1",
                               "--measure", "--format", "json"});
    ASSERT_EQ(baked.exit_code, 0) << baked.err;
    const json report = json::parse(baked.out);
    EXPECT_EQ(schema_error(load_schema("bake"), report), "");
    const std::string rays = std::to_string(report["figures"]["rays"]["count"].get<int>());
    const json validated = json::parse(validate({"m.spa", "--format", "json", "--rays", rays}).out);
    EXPECT_EQ(schema_error(load_schema("validate"), validated), "");
    EXPECT_EQ(report["figures"], validated["figures"]);
    const json inspected = json::parse(run({"inspect", "m.spa", "--format", "json"}).out);
    EXPECT_EQ(inspected["metadata"]["figures"], validated["figures"]);
    EXPECT_NEAR(inspected["parts"][0]["errors"]["captured_area"].get<double>(),
                validated["figures"]["captured_area"].get<double>(), 1e-6);
    run({"bake", "torus.glb", "-o", "one.spa", "--size", "32", "--layers", "1", "--measure", "--threads",
         "1"});
    EXPECT_EQ(read_file(folder_.path() / "one.spa"), read_file(folder_.path() / "m.spa"));
}

} // namespace
} // namespace spa::test
