// SPDX-License-Identifier: Apache-2.0
// The plots of `spa bench layers`: errors against the size of the map, logarithmic.
#pragma once

#include "bench_layers_report.h"
#include "bench_trace_plots.h"

#include <vector>

namespace spa::tools {

// One of the mean of the closed meshes, if there are several, with its bars, and one a mesh: false hits,
// missed hits and mean |dt|.
std::vector<Plot> layers_plots(const LayersReport& report);

} // namespace spa::tools
