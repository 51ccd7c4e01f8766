// SPDX-License-Identifier: Apache-2.0
// Crossings at single directions between the samples of an octahedral map, for many of them at once.
#pragma once

#include "candidates.h"
#include "crossings.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::bake {

// Of points i: crossings[first[i]] .. crossings[first[i + 1]), outermost first. Their normals and colours are
// left empty.
struct PointCrossings {
    std::vector<std::uint64_t> first; // points + 1
    std::vector<Crossing> crossings;
};

// Casts by the rules of crossings.h and gives what cast_radial does at samples: triangles are rasterised over
// the points, which lie in bins. Refers to the model. Immutable: one serves all threads.
class PointCaster {
public:
    // cells: N of the map whose samples alpha is filtered for. steps: a power of two; points are samples of
    // the octahedral grid of steps * N cells a side. O(vertices) time and memory.
    PointCaster(const CenteredModel& model, std::uint32_t cells, std::uint32_t steps);

    [[nodiscard]] const Grid& grid() const { return grid_; }

    // O(triangles + points + crossings). Deterministic; parallel in the caller's arena.
    [[nodiscard]] PointCrossings cast(std::span<const TexelIndex> points) const;

private:
    const CenteredModel& model_;
    std::uint32_t cells_, steps_;
    Grid grid_;
    Candidates candidates_;
};

} // namespace spa::bake
