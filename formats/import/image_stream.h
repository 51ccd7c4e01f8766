// SPDX-License-Identifier: Apache-2.0
// PNG and JPEG files without what decoders read besides the picture: colour profiles, comments, previews and
// other metadata, some of them compressed, whose readers are a larger target than those of the picture.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace spa::import {

// Of a PNG the signature, the critical chunks and the transparency of a palette or colour (tRNS). Nothing if
// that is the whole file. The chain of chunks has passed png_chunk_defect. O(n).
std::optional<std::vector<std::byte>> essential_png(std::span<const std::byte> bytes);

// Of a JPEG everything but comments and the application segments of the header other than APP0 (JFIF) and
// APP14 (Adobe), which say what the colours are. Nothing if that is the whole file. O(n).
std::optional<std::vector<std::byte>> essential_jpeg(std::span<const std::byte> bytes);

// How many scans a JPEG has. Each costs a decoder a pass over all pixels, and may take a few bytes. O(n).
std::size_t jpeg_scans(std::span<const std::byte> bytes);

} // namespace spa::import
