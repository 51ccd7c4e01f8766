// SPDX-License-Identifier: Apache-2.0
// What is extracted is what the container's own reader returns.
#include "process.h"
#include "schema.h"

#include "../../formats/container/reader.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace spa::test {
namespace {

struct Decoded {
    int width = 0, height = 0, channels = 0;
    OIIO::TypeDesc type;
    std::vector<float> samples;       // normalised to [0,1] for integers
    std::vector<std::uint8_t> codes8; // of 8-bit images
};

Decoded decode(const std::filesystem::path& path) {
    OIIO::ImageSpec raw_alpha;
    raw_alpha.attribute("oiio:UnassociatedAlpha", 1);
    const auto image = OIIO::ImageInput::open(path.string(), &raw_alpha);
    EXPECT_TRUE(image) << path;
    if (!image) return {};
    const OIIO::ImageSpec& spec = image->spec();
    Decoded result{spec.width, spec.height, spec.nchannels, spec.format, {}, {}};
    result.samples.resize(spec.image_pixels() * std::size_t(spec.nchannels));
    EXPECT_TRUE(image->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, result.samples.data()));
    if (spec.format == OIIO::TypeDesc::UINT8) {
        result.codes8.resize(result.samples.size());
        EXPECT_TRUE(image->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, result.codes8.data()));
    }
    return result;
}

class ExtractVerb : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(run_spa({"sample", "torus", "--level", "1", "-o", "torus.glb"}, folder_.path()).exit_code,
                  0);
    }
    void bake(const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"bake", "torus.glb", "-o", "torus.spa", "--size", "16"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = run_spa(arguments, folder_.path());
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        ASSERT_TRUE(container::open((folder_.path() / "torus.spa").string(), file_).ok());
    }
    Outcome extract(const std::string& output) {
        return run_spa({"extract", "torus.spa", "-o", output, "--format", "json"}, folder_.path());
    }
    [[nodiscard]] const Surface& outer() const { return file_.map().parts.at(0).layers.at(0).outer; }
    [[nodiscard]] Decoded image(const std::string& name) const {
        return decode(folder_.path() / "out" / name);
    }

    TemporaryFolder folder_;
    container::File file_;
};

TEST_F(ExtractVerb, ReportFollowsItsSchemaAndNamesWhatIsThere) {
    bake({});
    const Outcome outcome = extract("out");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("extract"), report), "");
    std::vector<std::string> expected{"out", "torus.glb", "torus.spa"};
    for (const nlohmann::json& entry : report["files"]) {
        const std::string name = "out/" + entry["name"].get<std::string>();
        expected.push_back(name);
        EXPECT_EQ(entry["bytes"], std::filesystem::file_size(folder_.path() / name));
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(folder_.names(), expected);
    for (const char* name :
         {"part0_layer0_outer_color.png", "part0_layer0_outer_depth.png", "part0_layer0_outer_normal.png",
          "part0_layer0_inner_color.png", "metadata.json"})
        EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / name)) << name;
    EXPECT_EQ(read_file(folder_.path() / "out/metadata.json"), file_.map().metadata);
}

TEST_F(ExtractVerb, ColorAndU8DepthAreTheStoredBytes) {
    bake({"--depth", "u8", "--normals", "rgb8", "--color-size", "32", "--samples", "2"});
    ASSERT_EQ(extract("out").exit_code, 0);
    const auto expect_stored = [&](const std::string& name, const ImageView& stored, int channels) {
        const Decoded decoded = image(name);
        EXPECT_EQ(decoded.width, int(stored.width)) << name;
        EXPECT_EQ(decoded.height, int(stored.height)) << name;
        EXPECT_EQ(decoded.channels, channels) << name;
        ASSERT_EQ(decoded.codes8.size(), stored.bytes.size()) << name;
        EXPECT_EQ(std::memcmp(decoded.codes8.data(), stored.bytes.data(), stored.bytes.size()), 0) << name;
    };
    expect_stored("part0_layer0_outer_color.png", outer().color, 4);
    expect_stored("part0_layer0_outer_depth.png", outer().depth, 1);
    expect_stored("part0_layer0_outer_normal.png", outer().normal, 3);
}

TEST_F(ExtractVerb, SixteenBitDepthIsTheNormalizedDepth) {
    bake({"--depth", "u16"});
    ASSERT_EQ(extract("out").exit_code, 0);
    const Decoded decoded = image("part0_layer0_outer_depth.png");
    EXPECT_EQ(decoded.type, OIIO::TypeDesc::UINT16);
    for (std::uint32_t y = 0; y < outer().depth.height; ++y)
        for (std::uint32_t x = 0; x < outer().depth.width; ++x)
            EXPECT_NEAR(decoded.samples[y * outer().depth.width + x],
                        decode_depth(ElementFormat::u16, outer().depth.at(x, y)), 1e-6);
}

TEST_F(ExtractVerb, FloatDepthIsExr) {
    bake({"--depth", "f32"});
    ASSERT_EQ(extract("out").exit_code, 0);
    const Decoded decoded = image("part0_layer0_outer_depth.exr");
    EXPECT_EQ(decoded.type, OIIO::TypeDesc::FLOAT);
    EXPECT_EQ(decoded.channels, 1);
    ASSERT_EQ(decoded.samples.size() * sizeof(float), outer().depth.bytes.size());
    EXPECT_EQ(std::memcmp(decoded.samples.data(), outer().depth.bytes.data(), outer().depth.bytes.size()), 0);
    EXPECT_GT(*std::max_element(decoded.samples.begin(), decoded.samples.end()), 0.5F);
}

TEST_F(ExtractVerb, OctahedralNormalsAreDecoded) {
    bake({"--normals", "oct16"});
    ASSERT_EQ(extract("out").exit_code, 0);
    const Decoded decoded = image("part0_layer0_outer_normal.png");
    EXPECT_EQ(decoded.type, OIIO::TypeDesc::UINT16);
    ASSERT_EQ(decoded.channels, 3);
    for (std::uint32_t y = 0; y < outer().normal.height; ++y)
        for (std::uint32_t x = 0; x < outer().normal.width; ++x) {
            const float* n = &decoded.samples[std::size_t(y * outer().normal.width + x) * 3];
            if (decode_depth(ElementFormat::u16, outer().depth.at(x, y)) == 0) {
                EXPECT_EQ(n[0] + n[1] + n[2], 0);
                continue;
            }
            const Vec3f stored = decode_normal(ElementFormat::oct16, outer().normal.at(x, y));
            EXPECT_NEAR(n[0] * 2 - 1, stored.x, 4e-5);
            EXPECT_NEAR(n[1] * 2 - 1, stored.y, 4e-5);
            EXPECT_NEAR(n[2] * 2 - 1, stored.z, 4e-5);
        }
}

TEST_F(ExtractVerb, AgainIntoTheSameFolderGivesTheSameBytes) {
    bake({"--depth", "f32"});
    ASSERT_EQ(extract("out").exit_code, 0);
    std::vector<std::string> first;
    for (const std::string& name : folder_.names())
        if (name.rfind("out/", 0) == 0) first.push_back(read_file(folder_.path() / name));
    write_file(folder_.path() / "out/mine.txt", "kept");
    ASSERT_EQ(extract("out").exit_code, 0);
    EXPECT_EQ(read_file(folder_.path() / "out/mine.txt"), "kept");
    std::filesystem::remove(folder_.path() / "out/mine.txt");
    std::vector<std::string> second;
    for (const std::string& name : folder_.names())
        if (name.rfind("out/", 0) == 0) second.push_back(read_file(folder_.path() / name));
    EXPECT_EQ(first, second);
}

TEST_F(ExtractVerb, NothingIsLeftOfADamagedFile) {
    bake({});
    std::string bytes = read_file(folder_.path() / "torus.spa");
    bytes[bytes.size() - 70] = char(~bytes[bytes.size() - 70]);
    write_file(folder_.path() / "torus.spa", bytes);
    EXPECT_EQ(extract("out").exit_code, 3);
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"torus.glb", "torus.spa"}));
}

TEST_F(ExtractVerb, FileInPlaceOfTheFolderIsRefused) {
    bake({});
    write_file(folder_.path() / "out", "a file");
    const Outcome outcome = extract("out");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("is not a folder"), std::string::npos) << outcome.err;
}

} // namespace
} // namespace spa::test
