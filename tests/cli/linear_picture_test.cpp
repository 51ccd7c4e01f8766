// SPDX-License-Identifier: Apache-2.0
// Pictures written by the command's encoders and read back as linear light.
#include "process.h"

#include "../../formats/import/linear_picture.h"
#include "../../libspa/core/element_format.h"
#include "../../libspa/core/error.h"
#include "../../tools/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace spa::test {
namespace {

using import::LinearPicture;

std::string text(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class LinearPictures : public testing::Test {
protected:
    LinearPicture read(const std::string& bytes, std::span<const std::string_view> layers = {},
                       const import::Limits& limits = {}) {
        write_file(path(), bytes);
        return import::read_picture(path(), layers, limits);
    }
    // "3: message"; empty if nothing is wrong.
    std::string refusal(const std::string& bytes, const import::Limits& limits = {}) {
        try {
            read(bytes, {}, limits);
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).rfind(path().string(), 0), 0U) << error.what();
            return std::to_string(int(error.code())) + ": " + error.what();
        }
        return {};
    }
    [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "picture"; }

    TemporaryFolder folder_;
};

std::vector<float> ramp(std::size_t count, float step) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = step * float(i);
    return values;
}

TEST_F(LinearPictures, ExrLayersComeBackExactly) {
    // Channels in an order that no reader keeps; values that a display cannot show.
    std::vector<float> red = ramp(6, 0.1F), green = ramp(6, 10), blue = ramp(6, -1), other = ramp(6, 3);
    green[2] = std::numeric_limits<float>::infinity();
    blue[3] = std::numeric_limits<float>::quiet_NaN();
    const std::vector<tools::ExrChannel> channels{
        {"indirect.B", red},  {"B", blue},        {"depth.Z", other}, {"R", red},
        {"indirect.R", blue}, {"direct.R", blue}, {"G", green},       {"indirect.G", other}};
    const std::string_view wanted[] = {"direct", "indirect", "none"};
    const LinearPicture picture = read(text(tools::encode_exr(3, 2, channels)), wanted);
    EXPECT_EQ(picture.width, 3U);
    EXPECT_EQ(picture.height, 2U);
    ASSERT_EQ(picture.layers.size(), 2U) << "a layer without all of its channels is none";
    EXPECT_EQ(picture.find("direct"), nullptr);
    const import::PictureLayer* const indirect = picture.find("indirect");
    ASSERT_NE(indirect, nullptr);
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3f p = picture.layers[0].pixels[i];
        EXPECT_EQ(p.x, red[i]);
        EXPECT_EQ(p.y, green[i]);
        EXPECT_TRUE(i == 3 ? std::isnan(p.z) : p.z == blue[i]);
        EXPECT_EQ(indirect->pixels[i].y, other[i]);
        EXPECT_EQ(indirect->pixels[i].z, red[i]);
    }
}

TEST_F(LinearPictures, CodesBecomeLight) {
    tools::Picture codes(256, 1, {});
    for (std::uint32_t x = 0; x < 256; ++x)
        codes.at(x, 0) = {std::uint8_t(x), std::uint8_t(255 - x), std::uint8_t(7)};
    const LinearPicture picture = read(text(tools::encode_png(codes)));
    for (std::uint32_t x = 0; x < 256; ++x) {
        EXPECT_NEAR(picture.layers[0].pixels[x].x, srgb_to_linear(std::uint8_t(x)), 1e-6F);
        EXPECT_NEAR(picture.layers[0].pixels[x].y, srgb_to_linear(std::uint8_t(255 - x)), 1e-6F);
        EXPECT_NEAR(picture.layers[0].pixels[x].z, srgb_to_linear(7), 1e-6F);
    }
    // Sixteen bits are not cut to eight, and one channel is grey.
    const std::vector<std::uint16_t> fine{0, 1000, 1001, 65535};
    const std::vector<Vec3f> grey = read(text(tools::encode_png16(2, 2, 1, fine))).layers[0].pixels;
    EXPECT_NE(grey[1].x, grey[2].x);
    EXPECT_EQ(grey[1].x, grey[1].z);
    EXPECT_EQ(grey[3], (Vec3f{1, 1, 1}));
}

TEST_F(LinearPictures, AlphaIsNotLookedAt) {
    const std::vector<std::uint8_t> rgba{200, 100, 50, 0, 200, 100, 50, 255};
    const std::vector<Vec3f> pixels = read(text(tools::encode_png8(2, 1, 4, rgba))).layers[0].pixels;
    EXPECT_EQ(pixels[0], pixels[1]);
    EXPECT_NEAR(pixels[0].x, srgb_to_linear(200), 1e-6F);
}

TEST_F(LinearPictures, WhatHasNoColourIsRefusedWithItsChannels) {
    const std::vector<float> values = ramp(4, 1);
    const std::vector<tools::ExrChannel> channels{
        {"depth.Z", values}, {"normal.X", values}, {"kind", values}};
    const std::string message = refusal(text(tools::encode_exr(2, 2, channels)));
    EXPECT_EQ(message.rfind("3: ", 0), 0U);
    EXPECT_NE(message.find("no channels R, G and B; there are: "), std::string::npos) << message;
    EXPECT_NE(message.find("depth.Z"), std::string::npos) << message;
}

TEST_F(LinearPictures, AMissingFileAndNoPicture) {
    EXPECT_THROW(import::read_picture(folder_.path() / "none.exr"), Error);
    EXPECT_EQ(refusal("").rfind("3: ", 0), 0U);
    EXPECT_EQ(refusal("no picture at all").rfind("3: ", 0), 0U);
}

TEST_F(LinearPictures, TheLimitHolds) {
    spa::import::Limits limits;
    limits.texture_pixels = 11;
    const std::vector<float> values = ramp(12, 1);
    for (const std::string& bytes :
         {text(tools::encode_exr(4, 3, values)), text(tools::encode_png(tools::Picture(4, 3, {})))}) {
        const std::string message = refusal(bytes, limits);
        EXPECT_NE(message.find("4 x 3 pixels, more than the limit of 11"), std::string::npos) << message;
    }
    limits.texture_pixels = 12;
    EXPECT_EQ(refusal(text(tools::encode_exr(4, 3, values)), limits), "");
}

// The window that the header claims is judged before a decoder sees it.
TEST_F(LinearPictures, AnExrThatClaimsALotIsRefused) {
    const std::vector<float> values = ramp(12, 1);
    std::string bytes = text(tools::encode_exr(4, 3, values));
    const std::size_t window = bytes.find(std::string("dataWindow\0box2i\0", 17));
    ASSERT_NE(window, std::string::npos);
    const auto with = [&](std::int32_t low, std::int32_t high) {
        std::string changed = bytes;
        std::memcpy(changed.data() + window + 21, &low, 4);
        std::memcpy(changed.data() + window + 29, &high, 4);
        return changed;
    };
    EXPECT_NE(refusal(with(0, 0x7FFFFFFE)).find("more than the limit"), std::string::npos);
    EXPECT_NE(refusal(with(std::numeric_limits<std::int32_t>::min(), 0x7FFFFFFF)).find("more than the limit"),
              std::string::npos);
    EXPECT_NE(refusal(with(3, 2)).find("no image header"), std::string::npos);
    spa::import::Limits limits;
    limits.texture_pixels = 11;
    EXPECT_NE(refusal(with(-7, -4), limits).find("4 x 3 pixels"), std::string::npos);
}

TEST_F(LinearPictures, NoDamageDoesHarm) {
    const std::vector<float> values = ramp(64, 0.01F);
    const std::vector<tools::ExrChannel> channels{{"R", values}, {"G", values}, {"B", values}};
    for (const std::string& whole : {text(tools::encode_exr(8, 8, channels)),
                                     text(tools::encode_png(tools::Picture(8, 8, {10, 20, 30})))}) {
        for (std::size_t length = 0; length < whole.size(); length += 7)
            static_cast<void>(refusal(whole.substr(0, length)));
        for (std::size_t at = 0; at < whole.size(); at += 3) {
            std::string damaged = whole;
            damaged[at] = char(damaged[at] ^ 0x5A);
            static_cast<void>(refusal(damaged));
        }
    }
}

} // namespace
} // namespace spa::test
