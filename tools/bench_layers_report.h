// SPDX-License-Identifier: Apache-2.0
// What `spa bench layers` says. Schema of the JSON: ../formats/schemas/bench-layers.schema.json.
#pragma once

#include "../libspa/bake/bake_options.h"
#include "../libspa/measure/layers_summary.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace spa::tools {

struct LayersReport {
    std::uint32_t rays = 0;
    std::uint64_t seed = 0;
    unsigned runs = 0;
    bake::Center center = bake::Center::bounds;
    std::string target;                      // the instruction set of streams
    std::vector<measure::LayersMesh> meshes; // under names of their own
    std::vector<std::string> sources;        // as given, one a mesh
    std::vector<measure::LayerFigures> mean; // closed_mean
    std::vector<measure::LayersBar> bars;    // layers_bars
};

// What the map of an open mesh loses, and why, in sentences; the usual size and number of intervals, with
// folds. Empty for a closed mesh.
std::string losses_text(const measure::LayersBenchmark& benchmark);

nlohmann::ordered_json report_json(const LayersReport& report);
// Tables of at most 110 columns.
std::string report_text(const LayersReport& report);
// A title line, then one line a mesh and map, and one a map of the mean under the name "closed mean".
std::string report_csv(const LayersReport& report);

} // namespace spa::tools
