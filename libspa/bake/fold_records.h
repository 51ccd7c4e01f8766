// SPDX-License-Identifier: Apache-2.0
// From the paths of an edge's crossings to its records. Source: ../../docs/layers.md, "Records".
#pragma once

#include "edge_paths.h"

#include "../core/folds.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::bake {

struct EdgeFolds {
    std::vector<FoldRecord> records; // none: the crossings match in order
    bool unresolved = false;         // the stored crossings are not those of the paths: all end in the middle
};

// points: those of `paths`. stored: how many of the crossings at each end the map holds, the outermost ones.
EdgeFolds fold_records(std::uint32_t edge, std::span<const EdgePoint> points, const EdgePaths& paths,
                       std::array<std::uint32_t, 2> stored);

} // namespace spa::bake
