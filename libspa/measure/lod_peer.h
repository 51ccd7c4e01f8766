// SPDX-License-Identifier: Apache-2.0
// The simplified mesh that is as exact as a map: what a renderer without maps would use instead.
#pragma once

#include "lods.h"

#include "../core/spherical_map.h"
#include "../mesh/model.h"

#include <optional>

namespace spa::measure {

struct LodPeer {
    double map_error = 0;   // mean |dt| of 20,000 random chords that hit both map and model, in R
    std::optional<Lod> lod; // in object space; none if no simplified mesh is as exact
    double lod_error = 0;   // likewise of the lod
};

// part: of this model, octahedral, its frame the identity; with all its layers. The coarsest of
// default_lod_errors() (bench_trace.h) whose mean |dt| is the map's or less. Parallel in the caller's arena;
// seconds for a million triangles.
LodPeer lod_peer(const Model& model, const Part& part);

} // namespace spa::measure
