// SPDX-License-Identifier: Apache-2.0
// Pictures are judged before a decoder sees them, and it sees the picture alone.
#include "../../formats/import/image_header.h"
#include "../../formats/import/image_stream.h"
#include "../../formats/import/texture.h"
#include "../../libspa/core/error.h"
#include "../import_mesh/scratch.h"
#include "png_bomb.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using import::ImageKind;

std::vector<std::byte> bytes_of(std::string_view text) {
    const auto* const data = reinterpret_cast<const std::byte*>(text.data());
    return {data, data + text.size()};
}

std::string text_of(const std::optional<std::vector<std::byte>>& bytes) {
    if (!bytes) return "as it was";
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

std::string refusal_of_texture(std::string_view bytes, const std::string& name = "a.png") {
    try {
        (void)import::read_texture(bytes_of(bytes), name, {});
    } catch (const Error& error) {
        EXPECT_TRUE(std::string_view(error.what()).starts_with(name + ": ")) << error.what();
        return error.what();
    }
    return "decoded";
}

std::string little_endian(std::uint64_t value, std::size_t count) {
    std::string out;
    for (std::size_t i = 0; i < count; ++i) out += char(value >> (8 * i) & 0xFFU);
    return out;
}

std::string big_endian(std::uint64_t value, std::size_t count) {
    const std::string out = little_endian(value, count);
    return {out.rbegin(), out.rend()};
}

TEST(ImageLimits, OfAPngThePictureAlone) {
    const std::string signature = "\x89PNG\r\n\x1A\n";
    const std::string head = png_chunk("IHDR", "0123456789abc"), end = png_chunk("IEND", "");
    const std::string palette = png_chunk("PLTE", "rgb"), alpha = png_chunk("tRNS", "a");
    const std::string pixels = png_chunk("IDAT", "pixels");
    const std::string plain = signature + head + palette + alpha + pixels + end;
    EXPECT_EQ(text_of(import::essential_png(bytes_of(plain))), "as it was");
    const std::string full = signature + head + png_chunk("iCCP", "profile") + png_chunk("gAMA", "1234") +
                             palette + png_chunk("zTXt", "") + alpha + pixels + png_chunk("fdAT", "frame") +
                             end + "more";
    EXPECT_EQ(text_of(import::essential_png(bytes_of(full))), plain);
    // A critical chunk that is not known is left for the decoder to refuse.
    const std::string unknown = signature + head + png_chunk("ABCD", "") + end;
    EXPECT_EQ(text_of(import::essential_png(bytes_of(unknown))), "as it was");
    EXPECT_EQ(text_of(import::essential_png({})), "as it was");
}

// A JPEG segment: FF, marker, length, content.
std::string segment(unsigned marker, std::string_view content) {
    return "\xFF" + std::string(1, char(marker)) + big_endian(content.size() + 2, 2) + std::string(content);
}

TEST(ImageLimits, OfAJpegThePictureAlone) {
    const std::string start = "\xFF\xD8", jfif = segment(0xE0, "JFIF"), adobe = segment(0xEE, "Adobe");
    const std::string frame = segment(0xC0, "frame");
    const std::string scan =
        segment(0xDA, "scan") + std::string("data\xFF\0data\xFF\xE1\0\2", 14) + "\xFF\xD9";
    const std::string plain = start + jfif + adobe + frame + scan;
    EXPECT_EQ(text_of(import::essential_jpeg(bytes_of(plain))), "as it was");
    const std::string full = start + jfif + segment(0xE1, "Exif \xFF\xDA") + segment(0xE2, "ICC_PROFILE") +
                             adobe + segment(0xFE, "comment") + frame + segment(0xED, "Photoshop") + scan;
    EXPECT_EQ(text_of(import::essential_jpeg(bytes_of(full))), plain);
    EXPECT_EQ(text_of(import::essential_jpeg({})), "as it was");
    for (std::size_t cut = 0; cut < full.size(); ++cut) // never reads behind the end
        (void)import::essential_jpeg(bytes_of(full.substr(0, cut)));
}

TEST(ImageLimits, ScansOfAJpeg) {
    const std::string start = "\xFF\xD8", frame = segment(0xC2, big_endian(0x0800'1000'1001, 6) + "....");
    const std::string scan = segment(0xDA, "scan") + std::string("x\xFF\0\xFF\xD0y", 6);
    const auto jpeg = [&](std::size_t scans) {
        std::string text = start + segment(0xE1, "\xFF\xDA thumbnail \xFF\xDA") + frame;
        for (std::size_t i = 0; i < scans; ++i) text += scan;
        return text + "\xFF\xD9" + scan;
    };
    EXPECT_EQ(import::jpeg_scans(bytes_of(jpeg(0))), 0U);
    EXPECT_EQ(import::jpeg_scans(bytes_of(jpeg(12))), 12U);
    EXPECT_EQ(import::jpeg_scans(bytes_of(jpeg(3) + scan)), 3U); // the end is the end
    EXPECT_NE(refusal_of_texture(jpeg(101)).find("it has 101 scans, more than the limit of 100"),
              std::string::npos);
    EXPECT_EQ(refusal_of_texture(jpeg(100)).find("scans, more than"), std::string::npos);
}

TEST(ImageLimits, SizesInHeaders) {
    struct Row {
        ImageKind kind;
        std::string bytes;
        std::uint64_t width, height;
    };
    const std::string bmp = "BM" + std::string(12, '\0');
    const std::string tiff_entries = little_endian(3, 2) + little_endian(0x0100, 2) + little_endian(3, 2) +
                                     little_endian(1, 4) + little_endian(300, 2) + "??" +
                                     little_endian(0x0101, 2) + little_endian(4, 2) + little_endian(1, 4) +
                                     little_endian(200'000, 4) + little_endian(0x0142, 2) +
                                     little_endian(3, 2) + little_endian(1, 4) + little_endian(16, 4);
    const Row rows[] = {
        {ImageKind::bmp,
         bmp + little_endian(40, 4) + little_endian(300, 4) + little_endian(std::uint32_t(-200), 4) +
             little_endian(1, 2) + little_endian(24, 2) + little_endian(0, 4),
         300, 200},
        {ImageKind::bmp,
         bmp + little_endian(12, 4) + little_endian(300, 2) + little_endian(200, 2) + std::string(20, '\1'),
         300, 200},
        {ImageKind::tga,
         std::string("\0\0\2", 3) + std::string(9, '\0') + little_endian(300, 2) + little_endian(200, 2) +
             "\x20 ",
         300, 200},
        {ImageKind::webp, "RIFF....WEBPVP8X....\x10..." + little_endian(299, 3) + little_endian(199, 3), 300,
         200},
        {ImageKind::webp,
         "RIFF....WEBPVP8L....\x2F" + little_endian(299U | 199U << 14U, 4) + std::string(5, '\0'), 300, 200},
        {ImageKind::webp,
         "RIFF....WEBPVP8 ....123\x9D\x01\x2A" + little_endian(300 | 0x4000, 2) + little_endian(200, 2), 300,
         200},
        {ImageKind::tiff, std::string("II*\0", 4) + little_endian(8, 4) + tiff_entries, 300, 200'000},
        {ImageKind::tiff,
         std::string("MM\0*", 4) + big_endian(8, 4) + big_endian(2, 2) + big_endian(0x0100, 2) +
             big_endian(3, 2) + big_endian(1, 4) + big_endian(300, 2) + "??" + big_endian(0x0101, 2) +
             big_endian(4, 2) + big_endian(1, 4) + big_endian(200'000, 4),
         300, 200'000},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(int(row.kind));
        const std::vector<std::byte> bytes = bytes_of(row.bytes);
        EXPECT_EQ(import::image_kind(bytes), row.kind == ImageKind::tga ? ImageKind::unknown : row.kind);
        const import::ImageHeader header = import::read_image_header(bytes, row.kind);
        EXPECT_EQ(header.width, row.width);
        EXPECT_EQ(header.height, row.height);
        for (std::size_t cut = 0; cut < bytes.size(); ++cut) // never reads behind the end
            (void)import::read_image_header(std::vector(bytes.begin(), bytes.begin() + std::ptrdiff_t(cut)),
                                            row.kind);
    }
    EXPECT_EQ(
        import::read_image_header(bytes_of(rows[6].bytes + little_endian(0x0143, 2) + little_endian(3, 2) +
                                           little_endian(1, 4) + little_endian(32, 4)),
                                  ImageKind::tiff)
            .tile_pixels,
        0U); // the directory has three entries
}

TEST(ImageLimits, ClaimsOfEachFormat) {
    const auto tga = [](unsigned type, std::uint64_t width, std::uint64_t height) {
        return std::string("\0\0", 2) + char(type) + std::string(9, '\0') + little_endian(width, 2) +
               little_endian(height, 2) + "\x20\x28";
    };
    EXPECT_NE(refusal_of_texture(tga(2, 100, 100), "a.tga").find("bytes cannot hold"), std::string::npos);
    EXPECT_NE(refusal_of_texture(tga(10, 9000, 9000), "a.tga").find("bytes cannot hold"), std::string::npos);
    EXPECT_NE(refusal_of_texture(tga(10, 60'000, 60'000), "a.tga").find("more than the limit"),
              std::string::npos);
    const std::string bmp = "BM" + std::string(12, '\0') + little_endian(40, 4);
    EXPECT_NE(refusal_of_texture(bmp + little_endian(4000, 4) + little_endian(4000, 4) + little_endian(1, 2) +
                                 little_endian(24, 2) + std::string(30, '\0'))
                  .find("bytes cannot hold"),
              std::string::npos);
    EXPECT_NE(refusal_of_texture("RIFF....WEBPVP8X....\x10..." + little_endian(16'000, 3) +
                                 little_endian(16'000, 3))
                  .find("bytes cannot hold"),
              std::string::npos);
    const auto tiff = [](std::uint64_t width, std::uint64_t tile) {
        std::string text = std::string("II*\0", 4) + little_endian(8, 4) + little_endian(4, 2);
        const std::pair<unsigned, std::uint64_t> entries[] = {
            {256, width}, {257, width}, {322, tile}, {323, tile}};
        for (const auto& [tag, value] : entries)
            text +=
                little_endian(tag, 2) + little_endian(4, 2) + little_endian(1, 4) + little_endian(value, 4);
        return text + little_endian(0, 4);
    };
    EXPECT_NE(refusal_of_texture(tiff(100'000, 16)).find("more than the limit"), std::string::npos);
    EXPECT_NE(refusal_of_texture(tiff(8000, 16)).find("bytes cannot hold"), std::string::npos);
    EXPECT_NE(refusal_of_texture(tiff(16, 65536)).find("it claims tiles of 4294967296 pixels"),
              std::string::npos);
}

TEST(ImageLimits, OtherFormatsAreNotRead) {
    using std::string_view_literals::operator""sv;
    for (const std::string_view signature :
         {"GIF89a"sv, "8BPS\0\1"sv, "DDS |"sv, "#?RADIANCE"sv, "\x76\x2F\x31\x01"sv, "\xABKTX 11"sv}) {
        try {
            (void)import::read_texture(bytes_of(std::string(signature) + std::string(64, '\1')), "a.png", {});
            ADD_FAILURE() << signature;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::unsupported) << error.what();
            EXPECT_NE(std::string_view(error.what()).find("which is not read; use PNG or JPEG"),
                      std::string_view::npos)
                << error.what();
        }
    }
}

} // namespace
} // namespace spa::test
