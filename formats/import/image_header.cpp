// SPDX-License-Identifier: Apache-2.0
#include "image_header.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace spa::import {
namespace {

bool starts_with(std::span<const std::byte> bytes, std::string_view signature, std::size_t offset = 0) {
    if (bytes.size() < offset || bytes.size() - offset < signature.size()) return false;
    return std::equal(signature.begin(), signature.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset),
                      [](char a, std::byte b) { return static_cast<std::byte>(a) == b; });
}

std::uint64_t big_endian(std::span<const std::byte> bytes, std::size_t offset, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value = value << 8U | std::to_integer<unsigned>(bytes[offset + i]);
    return value;
}

// Signature, then the IHDR chunk: length, "IHDR", width, height, bit depth, colour type (PNG, 11.2.2).
ImageHeader png_header(std::span<const std::byte> bytes) {
    if (bytes.size() < 26 || !starts_with(bytes, "IHDR", 12)) return {};
    constexpr std::array<std::uint64_t, 7> channels{1, 0, 3, 1, 2, 0, 4}; // by colour type
    const std::uint64_t color_type = big_endian(bytes, 25, 1);
    const std::uint64_t depth = big_endian(bytes, 24, 1);
    const std::uint64_t count = color_type < channels.size() ? channels[color_type] : 0;
    return {
        .width = big_endian(bytes, 16, 4), .height = big_endian(bytes, 20, 4), .pixel_bits = depth * count};
}

// Walks the marker segments to the first frame header, SOF0..SOF15 without DHT, JPG and DAC (ITU T.81, B.2).
ImageHeader jpeg_header(std::span<const std::byte> bytes) {
    std::size_t at = 2;
    while (at + 4 <= bytes.size()) {
        if (bytes[at] != std::byte{0xFF}) {
            ++at; // decoders skip garbage between segments
            continue;
        }
        const auto marker = std::to_integer<unsigned>(bytes[at + 1]);
        const bool stands_alone =
            marker == 0xFF || marker == 0x00 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
        if (stands_alone) {
            at += marker == 0xFF ? 1 : 2;
            continue;
        }
        if (marker == 0xD9 || marker == 0xDA) return {};
        const std::uint64_t length = big_endian(bytes, at + 2, 2);
        const bool frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (frame) {
            if (bytes.size() - at < 9) return {};
            return {.width = big_endian(bytes, at + 7, 2), .height = big_endian(bytes, at + 5, 2)};
        }
        at += 2 + std::max<std::uint64_t>(length, 2);
    }
    return {};
}

std::uint32_t little_endian(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8U | std::to_integer<unsigned>(bytes[offset + i]);
    return value;
}

// The end of a text that begins at `at`: where its zero is. The length of `bytes` if there is none.
std::size_t text_end(std::span<const std::byte> bytes, std::size_t at) {
    return static_cast<std::size_t>(
        std::find(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), std::byte{0}) -
        bytes.begin());
}

// Magic number and version, then attributes: name, type (texts that end with a zero), length, value. A zero
// ends them. The data window is two corners, both inside.
ImageHeader exr_header(std::span<const std::byte> bytes) {
    using std::string_view_literals::operator""sv;
    constexpr std::size_t box_bytes = 16;
    for (std::size_t at = 8; at < bytes.size() && bytes[at] != std::byte{0};) {
        const std::size_t type = text_end(bytes, at) + 1;
        if (type >= bytes.size()) return {};
        const std::size_t length_at = text_end(bytes, type) + 1;
        if (length_at >= bytes.size() || bytes.size() - length_at < 4) return {};
        const std::uint64_t length = little_endian(bytes, length_at);
        const std::size_t value = length_at + 4;
        if (length > bytes.size() - value) return {};
        if (starts_with(bytes, "dataWindow\0box2i\0"sv, at) && length == box_bytes) {
            std::array<std::int64_t, 4> box{};
            for (std::size_t i = 0; i < box.size(); ++i)
                box[i] = static_cast<std::int32_t>(little_endian(bytes, value + 4 * i));
            if (box[2] < box[0] || box[3] < box[1]) return {};
            return {.width = static_cast<std::uint64_t>(box[2] - box[0] + 1),
                    .height = static_cast<std::uint64_t>(box[3] - box[1] + 1)};
        }
        at = value + length;
    }
    return {};
}

std::uint64_t little_endian_16(std::span<const std::byte> bytes, std::size_t offset) {
    return std::to_integer<std::uint64_t>(bytes[offset]) | std::to_integer<std::uint64_t>(bytes[offset + 1])
                                                               << 8U;
}

// BITMAPFILEHEADER, then BITMAPCOREHEADER (12 bytes) or one of those that begin as BITMAPINFOHEADER does.
ImageHeader bmp_header(std::span<const std::byte> bytes) {
    constexpr std::uint32_t core_header = 12;
    if (bytes.size() < 34) return {};
    if (little_endian(bytes, 14) == core_header)
        return {.width = little_endian_16(bytes, 18),
                .height = little_endian_16(bytes, 20),
                .pixel_bits = little_endian_16(bytes, 24)};
    const auto height = static_cast<std::int32_t>(little_endian(bytes, 22)); // negative: from the top
    const std::uint32_t compression = little_endian(bytes, 30);
    return {.width = little_endian(bytes, 18),
            .height = static_cast<std::uint64_t>(std::abs(std::int64_t{height})),
            .pixel_bits = little_endian_16(bytes, 28),
            .packed = compression == 1 || compression == 2};
}

ImageHeader tga_header(std::span<const std::byte> bytes) {
    if (bytes.size() < 18) return {};
    return {.width = little_endian_16(bytes, 12),
            .height = little_endian_16(bytes, 14),
            .pixel_bits = std::to_integer<std::uint64_t>(bytes[16]),
            .packed = std::to_integer<unsigned>(bytes[2]) >= 8};
}

// The first chunk after "RIFF", size, "WEBP" says how large the picture is (RFC 9649).
ImageHeader webp_header(std::span<const std::byte> bytes) {
    if (bytes.size() < 30) return {};
    if (starts_with(bytes, "VP8X", 12))
        return {.width = 1 + (little_endian(bytes, 24) & 0xFFFFFFU),
                .height = 1 + (little_endian(bytes, 26) >> 8U)};
    if (starts_with(bytes, "VP8L", 12)) {
        const std::uint32_t sizes = little_endian(bytes, 21);
        return {.width = 1 + (sizes & 0x3FFFU), .height = 1 + (sizes >> 14U & 0x3FFFU)};
    }
    if (starts_with(bytes, "VP8 ", 12))
        return {.width = little_endian_16(bytes, 26) & 0x3FFFU,
                .height = little_endian_16(bytes, 28) & 0x3FFFU};
    return {};
}

// The entries of the first directory: tag, type, count, value (TIFF 6.0, 2).
ImageHeader tiff_header(std::span<const std::byte> bytes) {
    if (bytes.size() < 8) return {};
    const bool big = bytes[0] == std::byte{'M'};
    const auto load = [&](std::size_t at, std::size_t count) {
        if (big) return big_endian(bytes, at, count);
        return count == 2 ? little_endian_16(bytes, at) : std::uint64_t{little_endian(bytes, at)};
    };
    constexpr std::size_t entry_bytes = 12;
    const std::uint64_t directory = load(4, 4);
    if (directory > bytes.size() || bytes.size() - directory < 2) return {};
    ImageHeader header;
    std::uint64_t tile_width = 0, tile_height = 0;
    const std::uint64_t count = load(directory, 2);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = directory + 2 + i * entry_bytes;
        if (at > bytes.size() || bytes.size() - at < entry_bytes) break;
        constexpr std::uint64_t short_type = 3;
        const std::uint64_t number = load(at + 8, load(at + 2, 2) == short_type ? 2 : 4);
        switch (load(at, 2)) {
        case 256: header.width = number; break;
        case 257: header.height = number; break;
        case 322: tile_width = number; break;
        case 323: tile_height = number; break;
        default: break;
        }
    }
    header.tile_pixels = tile_width * tile_height;
    return header;
}

} // namespace

ImageKind image_kind(std::span<const std::byte> bytes) {
    using std::string_view_literals::operator""sv;
    struct Row {
        std::string_view signature;
        ImageKind kind;
    };
    constexpr std::array rows{
        Row{"\x89PNG\r\n\x1A\n"sv, ImageKind::png},
        Row{"\xFF\xD8\xFF"sv, ImageKind::jpeg},
        Row{"GIF8"sv, ImageKind::gif},
        Row{"BM"sv, ImageKind::bmp},
        Row{"II*\0"sv, ImageKind::tiff},
        Row{"MM\0*"sv, ImageKind::tiff},
        Row{"8BPS"sv, ImageKind::psd},
        Row{"DDS "sv, ImageKind::dds},
        Row{"#?"sv, ImageKind::hdr},
        Row{"\x76\x2F\x31\x01"sv, ImageKind::exr},
        Row{"\xABKTX "sv, ImageKind::ktx},
    };
    for (const Row& row : rows)
        if (starts_with(bytes, row.signature)) return row.kind;
    if (starts_with(bytes, "RIFF") && starts_with(bytes, "WEBP", 8)) return ImageKind::webp;
    return ImageKind::unknown;
}

std::string png_chunk_defect(std::span<const std::byte> bytes) {
    constexpr std::size_t overhead = 12; // length, type and checksum
    for (std::size_t at = 8; at < bytes.size();) {
        if (bytes.size() - at < overhead) return "it ends within a chunk";
        const std::uint64_t length = big_endian(bytes, at, 4);
        const std::size_t left = bytes.size() - at - overhead;
        if (length > left)
            return "the chunk at byte " + std::to_string(at) + " claims " + std::to_string(length) +
                   " bytes, but " + std::to_string(left) + " are left";
        if (starts_with(bytes, "IEND", at + 4)) return {};
        at += overhead + length;
    }
    return {};
}

ImageHeader read_image_header(std::span<const std::byte> bytes, ImageKind kind) {
    switch (kind) {
    case ImageKind::png: return png_header(bytes);
    case ImageKind::jpeg: return jpeg_header(bytes);
    case ImageKind::webp: return webp_header(bytes);
    case ImageKind::bmp: return bmp_header(bytes);
    case ImageKind::tga: return tga_header(bytes);
    case ImageKind::tiff: return tiff_header(bytes);
    case ImageKind::exr: return exr_header(bytes);
    default: return {};
    }
}

} // namespace spa::import
