// SPDX-License-Identifier: Apache-2.0
// From a model in pieces to a map with a part for each.
#pragma once

#include "bake.h"

#include "../mesh/partition.h"

#include <span>
#include <vector>

namespace spa::bake {

struct PartsResult {
    OwnedMap map;                // one part a piece, in their order; metadata is left to the caller
    std::vector<Report> reports; // the same
};

// Bakes every piece as bake_model does a model: with a centre, a frame and a radius of its own. Same model,
// partition and options, same bytes. Throws as bake_model does; the message says which piece.
PartsResult bake_parts(const Model& model, const Partition& partition, const Options& options,
                       const Progress& progress = {});

// What a report says of the whole: counts are summed, shares are means weighted by the pieces' triangles;
// something is so where it is so for any piece. Warnings name their piece. reports: at least one; of one
// piece alone its own report.
Report sum(std::span<const Report> reports, const Partition& partition);

// "part 3 (arm)"
std::string part_name(const Partition& partition, std::size_t part);

} // namespace spa::bake
