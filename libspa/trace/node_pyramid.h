// SPDX-License-Identifier: Apache-2.0
// The pyramid of w-ranges over a map's cells: what the projective trace skips by (shaders/spa_projective.h).
#pragma once

#include "map_surface.h"

#include <cstdint>
#include <vector>

namespace spa::trace {

struct NodePyramid {
    std::uint32_t words = 1; // of a node: 1, the float at which it begins, or 2, a range of two codes each
    std::uint32_t code_base = 0, code_shift = 0;
    std::vector<std::uint32_t> nodes;
    std::vector<float> cores; // one a node; empty: nowhere is everything solid to the centre
};

// words: 1 or 2. w_core: no ray reaches a greater w. A node covers everything below it, the smallest gaps
// closed. Ends are rounded outward: by more than a float ray may be off, and to the next code. O(cells).
NodePyramid build_pyramid(const MapCells& cells, float w_core, std::uint32_t words);

} // namespace spa::trace
