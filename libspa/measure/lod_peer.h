// SPDX-License-Identifier: Apache-2.0
// The simplified mesh that is as exact as a map: what a renderer without maps would use instead.
#pragma once

#include "lods.h"

#include "../core/spherical_map.h"
#include "../mesh/model.h"

#include <optional>

namespace spa::measure {

// A simplified mesh in object space and its error: |dt| of random chords that hit both, in R.
struct MeasuredLod {
    Lod lod;
    double mean = 0, median = 0;
};

struct LodPeer {
    double map_mean = 0, map_median = 0;  // of the map
    std::optional<MeasuredLod> by_mean;   // the coarsest whose mean is the map's or less
    std::optional<MeasuredLod> by_median; // the same of the median, which a few rays at a rim do not decide
};

// part: of this model, octahedral, its frame the identity; with all its layers. The meshes are those of
// default_lod_errors() (bench_trace.h); none: no simplified mesh is as exact. 20,000 rays. Parallel in the
// caller's arena; seconds for a million triangles.
LodPeer lod_peer(const Model& model, const Part& part);

} // namespace spa::measure
