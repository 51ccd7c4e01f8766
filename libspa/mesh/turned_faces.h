// SPDX-License-Identifier: Apache-2.0
// Which triangles of a soup are wound against their neighbours.
#pragma once

#include "model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa {

// One entry a triangle: 1 if it is wound against most of its patch. A patch is what hangs together over edges
// that two triangles share, no more and no fewer; which of its two sides is the outer one is not asked here,
// and where a patch has but one side (Moebius), which triangles are turned depends on their order.
// first: of weld_positions(). O(n log n) time, 48 bytes a triangle. Deterministic; parallel in the caller's
// arena.
std::vector<std::uint8_t> find_turned_faces(const Model& model, std::span<const std::uint32_t> first);

} // namespace spa
