// SPDX-License-Identifier: Apache-2.0
// How exact a map of one part or several is.
#pragma once

#include "measure_map.h"

#include "../mesh/partition.h"

#include <span>
#include <vector>

namespace spa::measure {

struct PartsMeasurement {
    Measurement whole;
    std::vector<Measurement> parts; // of more than one: each against its piece, without rays
};

// Every part against the piece of the model that it was baked from, and with options.rays all together
// against the whole model. Of one part: measure_map. Points on the surface are shared out among the pieces by
// area. Throws as measure_map does.
PartsMeasurement measure_parts(const Model& model, const Partition& partition, std::span<const Part> parts,
                               const MeasureOptions& options, const bake::Progress& progress = {});

} // namespace spa::measure
