// SPDX-License-Identifier: Apache-2.0
// The connected pieces of a triangle soup, and whether it is closed.
#pragma once

#include "model.h"

#include <cstdint>
#include <vector>

namespace spa {

struct Components {
    std::vector<std::uint32_t> of_triangle; // one entry a triangle, in [0, count); numbered by first triangle
    std::uint32_t count = 0;
    // Directed edges (between welded vertices) that lack a partner in the opposite direction: 0 for a closed,
    // consistently oriented mesh. Edges between coincident vertices do not count.
    std::uint64_t open_edges = 0;
    // Per triangle, 1: wound against its neighbours (turned_faces.h). Empty if no edge is passed twice in one
    // direction.
    std::vector<std::uint8_t> turned;

    // Whether a front face counts as a back face, and the other way round.
    [[nodiscard]] bool is_turned(std::uint32_t triangle) const {
        return !turned.empty() && turned[triangle] != 0;
    }
};

// Vertices at the same position (weld.h) are one; triangles that share a vertex are connected.
// O(n log n) time, O(n) memory. Parallel in the caller's arena; the result does not depend on it.
Components find_components(const Model& model);

} // namespace spa
