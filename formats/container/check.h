// SPDX-License-Identifier: Apache-2.0
// THE checker of `.spa` files: `spa validate`, every reader, the writer, the fuzzer and the tests use the
// same rules, those of ../SPA.md. Safe for any bytes: no crash, no exception, no allocation beyond the
// limits.
#pragma once

#include "limits.h"
#include "status.h"

#include <cstddef>
#include <span>

namespace spa::container {

enum class CheckDepth : std::uint8_t {
    // Header, section table and parts, with their checksums: that every image can be found and decoded into
    // memory of known size. Touches only the front of the file.
    structure,
    // Also every checksum, padding, decompression, metadata, and the codes in the images.
    full,
};

// The first issue found, in the order of ../SPA.md, "Reading". `file` is the whole file. Full: O(decoded
// bytes) time, and memory for the decoded bytes of compressed sections.
Status check(std::span<const std::byte> file, const Limits& limits = {},
             CheckDepth depth = CheckDepth::full) noexcept;

} // namespace spa::container
