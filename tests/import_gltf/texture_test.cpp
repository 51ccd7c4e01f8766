// SPDX-License-Identifier: Apache-2.0
// Pictures of every kind that glTF allows, and damaged ones, alone and bound to a quad.
#include "gltf_builder.h"

#include "../../formats/import/image_header.h"
#include "../../formats/import/source_file.h"
#include "../../formats/import/texture.h"
#include "../../libspa/core/error.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

Texture read(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = import::read_file(path, {}).bytes;
    return import::read_texture(bytes, path.filename().string(), {});
}

Pixel pixel(const Texture& texture, std::uint32_t x, std::uint32_t y) {
    const Image& image = texture.mips[0];
    return image.pixels[std::size_t{y} * image.width + x];
}

void expect_close(Pixel a, Pixel b, int tolerance) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(int(a[c]), int(b[c]), tolerance);
}

// PngSuite draws known ramps: see its own descriptions.
TEST(Texture, PngKinds) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    const std::filesystem::path folder = assets() / "textures/png";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path());
        const Texture texture = read(entry.path());
        ASSERT_EQ(texture.mips.size(), 6U);
        EXPECT_EQ(texture.mips[0].width, 32U);
        EXPECT_EQ(texture.mips[0].height, 32U);
        EXPECT_EQ(texture.mips[5].pixels.size(), 1U);
    }
    // One bit grey: white upper left, black lower right.
    const Texture bits = read(folder / "basn0g01.png");
    EXPECT_EQ(pixel(bits, 0, 0), (Pixel{255, 255, 255, 255}));
    EXPECT_EQ(pixel(bits, 31, 31), (Pixel{0, 0, 0, 255}));
    // 16 bit colour: reduced to 8, opaque.
    EXPECT_EQ(pixel(read(folder / "basn2c16.png"), 0, 0), (Pixel{255, 255, 0, 255}));
    // Grey and alpha: alpha runs from left to right, grey from top to bottom; straight, not multiplied.
    const Texture grey_alpha = read(folder / "basn4a08.png");
    EXPECT_EQ(pixel(grey_alpha, 0, 0), (Pixel{255, 255, 255, 0}));
    EXPECT_EQ(pixel(grey_alpha, 31, 0), (Pixel{255, 255, 255, 255}));
    EXPECT_EQ(pixel(grey_alpha, 31, 31), (Pixel{0, 0, 0, 255}));
    // Interlaced colour and alpha.
    EXPECT_EQ(pixel(read(folder / "ibasn6a08.png"), 31, 0)[3], 255);
    EXPECT_EQ(pixel(read(folder / "ibasn6a08.png"), 0, 0)[3], 0);
}

TEST(Texture, JpegKinds) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    const std::filesystem::path folder = assets() / "textures/jpeg";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path());
        const Texture texture = read(entry.path());
        const auto bytes = import::read_file(entry.path(), {}).bytes;
        const import::ImageHeader header = import::read_image_header(bytes, import::ImageKind::jpeg);
        EXPECT_EQ(texture.mips[0].width, header.width);
        EXPECT_EQ(texture.mips[0].height, header.height);
        for (const Pixel& p : texture.mips[0].pixels) ASSERT_EQ(p[3], 255);
    }
    const Texture grey = read(folder / "jpg-gray.jpg");
    expect_close(pixel(grey, 0, 0), {255, 255, 255, 255}, 2);
    expect_close(pixel(grey, 31, 31), {0, 0, 0, 255}, 2);
    // The same picture by screen colours and by inks.
    const Texture color = read(folder / "jpg-progressive.jpg"), inks = read(folder / "jpg-cmyk-1.jpg");
    for (const std::uint32_t y : {0U, 10U, 31U})
        for (const std::uint32_t x : {0U, 20U, 31U}) expect_close(pixel(color, x, y), pixel(inks, x, y), 12);
    expect_close(pixel(inks, 31, 0), {0, 255, 0, 255}, 8);
}

TEST(Texture, TargaIsKnownByItsName) {
    const Scratch scratch;
    scratch.write_tga("a.tga", 2, {{10, 20, 30, 40}, {50, 60, 70, 80}, {1, 2, 3, 4}, {5, 6, 7, 8}});
    const Texture texture = read(scratch.write("b.txt", "").parent_path() / "a.tga");
    EXPECT_EQ(pixel(texture, 0, 0), (Pixel{10, 20, 30, 40}));
    EXPECT_EQ(pixel(texture, 1, 1), (Pixel{5, 6, 7, 8}));
}

std::string refusal_of_texture(std::span<const std::byte> bytes, const import::Limits& limits = {}) {
    try {
        (void)import::read_texture(bytes, "name.png", limits);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data) << error.what();
        EXPECT_EQ(std::string_view(error.what()).rfind("name.png: ", 0), 0U) << error.what();
        return error.what();
    }
    return "decoded";
}

TEST(Texture, ClaimsAreJudgedBeforeDecoding) {
    // Signature and IHDR of a PNG of 2^31 - 1 squared, of 20000 squared and of no height.
    const auto png = [](std::uint32_t width, std::uint32_t height) {
        std::string bytes("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR", 16);
        for (const std::uint32_t value : {width, height})
            for (unsigned shift = 32; shift > 0; shift -= 8) bytes += char(value >> (shift - 8) & 0xFFU);
        bytes += std::string("\x08\x06\0\0\0....", 9);
        std::vector<std::byte> out(bytes.size());
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<std::byte>(bytes[i]);
        return out;
    };
    EXPECT_NE(refusal_of_texture(png(0x7FFFFFFF, 0x7FFFFFFF)).find("more than the limit"), std::string::npos);
    EXPECT_NE(refusal_of_texture(png(10000, 10000)).find("bytes cannot hold"), std::string::npos);
    EXPECT_NE(refusal_of_texture(png(10, 0)).find("claims no pixels"), std::string::npos);
    import::Limits limits;
    limits.texture_pixels = 99;
    EXPECT_NE(refusal_of_texture(png(10, 10), limits).find("more than the limit of 99"), std::string::npos);
    EXPECT_NE(refusal_of_texture({}).find("it is empty"), std::string::npos);
}

// A quad with this picture on it, as a GLB.
std::string quad_with(const std::vector<std::byte>& picture) {
    GltfBuilder builder = triangle();
    const int view = builder.add_view({reinterpret_cast<const char*>(picture.data()), picture.size()});
    const int uv = builder.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = uv;
    primitive["material"] = 0;
    builder.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    return builder.glb();
}

TEST(Texture, DamagedPicturesAreNamedOrDecoded) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    const Scratch scratch;
    const std::set<std::string> decodable{"empty_ancillary_chunks.png", "regression-palette-8.png",
                                          "small-palette-4.png", "test-palette-2.png",
                                          "dc-predictor-overflow.jpg"};
    for (const char* kind : {"png", "jpeg"}) {
        for (const auto& entry : std::filesystem::directory_iterator(assets() / "malformed" / kind)) {
            SCOPED_TRACE(entry.path());
            const std::vector<std::byte> bytes = import::read_file(entry.path(), {}).bytes;
            const std::string message =
                scratch.refusal("a.glb", bytes.empty() ? quad_with({std::byte{0}}) : quad_with(bytes));
            const bool refused =
                message.find("images[0]: cannot be decoded as an image: ") != std::string::npos;
            EXPECT_TRUE(refused || message == "imported") << message;
            EXPECT_EQ(refused, decodable.count(entry.path().filename().string()) == 0);
        }
    }
}

} // namespace
} // namespace spa::test
