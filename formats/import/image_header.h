// SPDX-License-Identifier: Apache-2.0
// What the first bytes of a picture say, read without a decoder: decoders allocate what a header claims, so
// the claims are judged before a decoder sees them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace spa::import {

enum class ImageKind { unknown, png, jpeg, gif, bmp, tiff, webp, psd, dds, hdr, exr, ktx };

// By signature. TGA has none: unknown.
ImageKind image_kind(std::span<const std::byte> bytes);

struct ImageHeader {
    std::uint64_t width = 0, height = 0; // 0: not found
    std::uint64_t pixel_bits = 0;        // of a stored pixel; PNG only
};

// The size that a PNG, JPEG or OpenEXR file claims (of the latter the data window of its first part); width 0
// for other kinds and for what holds no valid header.
ImageHeader read_image_header(std::span<const std::byte> bytes);

// What is wrong with the chain of chunks of a PNG: one that claims more bytes than are left. Empty if they
// fit. Decoders allocate a chunk before they read it.
std::string png_chunk_defect(std::span<const std::byte> bytes);

} // namespace spa::import
