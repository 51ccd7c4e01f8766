// SPDX-License-Identifier: Apache-2.0
// PNG files that are small and decode to a lot, made without a compressor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace spa::test {

// A zlib stream of so many equal bytes, about 159 of them for each of its own.
std::string compressed_run(char byte, std::size_t count);

// A chunk with its checksum.
std::string png_chunk(std::string_view type, std::string_view data);

// A PNG of one channel of one bit, all zeros, with `chunks` between header and pixels.
std::string black_png(std::uint32_t width, std::uint32_t height, std::string_view chunks = {});

} // namespace spa::test
