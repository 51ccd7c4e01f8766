// SPDX-License-Identifier: Apache-2.0
// Which vertices lie at the same place.
#pragma once

#include "../core/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa {

// For each position the index of the first one that is bit-equal to it (0 and -0 alike; every NaN pattern is
// equal to itself only). At most 2^32 - 1 positions. O(n) time by hashing; where a file was made so that its
// hashes collide, O(n log n) by sorting. Parallel in the caller's arena; the result does not depend on it.
std::vector<std::uint32_t> weld_positions(std::span<const Vec3f> positions);

} // namespace spa
