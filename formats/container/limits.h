// SPDX-License-Identifier: Apache-2.0
// What a caller is willing to read. A file that claims more is refused before anything is allocated for it.
#pragma once

#include <cstdint>

namespace spa::container {

// The defaults hold for any file a bake writes on one machine, and keep a hostile one from taking more than
// raw_bytes of memory. Lower them where the data is known to be small.
struct Limits {
    std::uint64_t file_bytes = std::uint64_t(16) << 30U;
    std::uint32_t sections = 65536;
    std::uint32_t parts = 16384;
    std::uint32_t layers = 64;                             // of one part
    std::uint64_t image_samples = std::uint64_t(1) << 28U; // of one image
    std::uint64_t raw_bytes = std::uint64_t(4) << 30U;     // of all known sections, decoded
    std::uint64_t metadata_bytes = std::uint64_t(16) << 20U;
};

// The limits of a file that this process has just made itself.
constexpr Limits no_limits{UINT64_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX,
                           UINT64_MAX, UINT64_MAX, UINT64_MAX};

} // namespace spa::container
