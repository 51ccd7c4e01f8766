// SPDX-License-Identifier: Apache-2.0
// How the crossings of neighbouring samples belong together, where they do not simply continue one another.
// Source: ../../docs/layers.md, "Matching".
#pragma once

#include "bake.h"
#include "crossings.h"
#include "intervals.h"
#include "surface_end.h"

#include "../core/folds.h"
#include "../mesh/components.h"

#include <cstdint>
#include <vector>

namespace spa::bake {

struct Folds {
    std::vector<FoldRecord> records; // edges ascending
    FoldStatistics statistics;
};

// The larger the map, the fewer of its edges have folds; this is where their numbers stay within bounds.
constexpr std::uint32_t most_fold_cells = 4096;
constexpr std::uint32_t most_fold_layers = fold_indices / 2;

// surfaces: of pair_intervals(), octahedral, at most most_fold_cells a side and most_fold_layers.
// matching_edges: of match_edges(); edges that turn out to need no record, because what is found between the
// samples tells that their crossings match in order, are set to 1. Edges that do not match are halved, up to
// four times, where points_match() is false. Deterministic; parallel in the caller's arena. Throws Cancelled.
Folds find_folds(const CenteredModel& model, const Components& components, const Orientation& orientation,
                 const SurfaceGrid& surfaces, std::vector<std::uint8_t>& matching_edges);

} // namespace spa::bake
