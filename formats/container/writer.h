// SPDX-License-Identifier: Apache-2.0
// Writer of `.spa` files. The bytes depend on the map, the options and the version of the Zstandard library,
// on nothing else.
#pragma once

#include "format.h"
#include "status.h"

#include <string>
#include <vector>

namespace spa::container {

enum class Compression : std::uint8_t {
    none, // images can be used where they lie
    zstd, // depths and normals as Scheme::filtered_zstd, colours as that or zstd, whichever is smaller,
          // metadata, mixed triangles and folds as zstd; what does not shrink stays as it is
};

struct WriteOptions {
    Compression compression = Compression::zstd;
    // Measured on u16 depth and oct16 normals, 257 x 257: level 9 takes 6 ms an image, level 15 takes 30 ms
    // for 3 % less, level 19 takes 80 ms for no more than that.
    int zstd_level = 9;
};

// Checks the map by the rules of check.h, and writes it. A status about content names the section that would
// have been at fault; image_view_not_valid: a view whose size, format and bytes do not agree. O(bytes) memory
// beside the map with compression, next to none without.
Status write(const SphericalMap& map, const WriteOptions& options, std::vector<std::byte>& out) noexcept;

// The same into a file: under a temporary name beside `path`, flushed, then renamed to `path`. On failure
// what was at `path` is untouched and nothing is left behind.
Status write(const SphericalMap& map, const WriteOptions& options, const std::string& path) noexcept;

} // namespace spa::container
