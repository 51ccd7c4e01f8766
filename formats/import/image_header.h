// SPDX-License-Identifier: Apache-2.0
// What the first bytes of a picture say, read without a decoder: decoders allocate what a header claims, so
// the claims are judged before a decoder sees them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace spa::import {

enum class ImageKind { unknown, png, jpeg, webp, bmp, tga, tiff, exr, gif, psd, dds, hdr, ktx };

// By signature. TGA has none: unknown.
ImageKind image_kind(std::span<const std::byte> bytes);

struct ImageHeader {
    std::uint64_t width = 0, height = 0; // 0: not found
    std::uint64_t pixel_bits = 0;        // of a stored pixel; PNG, BMP and TGA only
    std::uint64_t tile_pixels = 0;       // that are decoded at once; TIFF only, 0: no tiles
    bool packed = false;                 // BMP and TGA: runs of equal pixels are stored as one
};

// The size that a file of this kind claims (of OpenEXR the data window of its first part, of TIFF the first
// directory); width 0 for what holds no valid header and for the kinds from gif on.
ImageHeader read_image_header(std::span<const std::byte> bytes, ImageKind kind);

// What is wrong with the chain of chunks of a PNG: one that claims more bytes than are left. Empty if they
// fit. Decoders allocate a chunk before they read it.
std::string png_chunk_defect(std::span<const std::byte> bytes);

} // namespace spa::import
