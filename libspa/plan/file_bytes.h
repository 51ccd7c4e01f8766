// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../core/spherical_map.h"

#include <cstdint>

namespace spa::plan {

// What a file with this map takes: it is encoded in memory. compress: as container::Compression::zstd. Throws
// Error{internal} for a map that cannot be written. O(bytes).
std::uint64_t file_bytes(const SphericalMap& map, bool compress);

} // namespace spa::plan
