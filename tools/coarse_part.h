// SPDX-License-Identifier: Apache-2.0
// Parts with fewer samples, for pictures that would not show more.
#pragma once

#include "../libspa/core/spherical_map.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace spa::tools {

// A part that owns its pixels. Movable; the views stay valid.
struct CoarsePart {
    Part part;
    std::vector<std::vector<std::byte>> pixels;
};

// The part as an octahedral map in which no image has more than `cells` cells a side. Every sample is the
// nearest one of the original, so nothing is filtered; from an octahedral map with a multiple of `cells` they
// are exactly the original's. Images that are small enough already are shared with `part`, which outlives the
// result. The list of mixed triangles stays only if the depths do. cells: even, >= 2. O(cells^2) an image.
CoarsePart coarse_part(const Part& part, std::uint32_t cells);

} // namespace spa::tools
