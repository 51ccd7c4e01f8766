// SPDX-License-Identifier: Apache-2.0
// The figures of a measurement that a map can be asked to keep. What they mean: ../../docs/measures.md.
#pragma once

#include "../measure/measure_map.h"

#include <cstdint>
#include <span>

namespace spa::plan {

// Distances are in R, shares in [0,1].
enum class Metric : std::uint8_t {
    p95_dt, // of |dt| along rays that hit map and model
    p99_dt,
    mean_dt,
    false_hits,  // share of rays that hit the map alone
    missed_hits, // share of rays that hit the model alone
    p95_surface, // of the distances between the two surfaces, the larger of both ways
    hausdorff,   // the largest of them
};

// All of them, in this order.
std::span<const Metric> metrics();
// "p95-dt", ...
const char* name(Metric metric);
// Whether rays tell, which only octahedral maps can be traced by; the others are of surfaces.
bool is_of_rays(Metric metric);
bool is_share(Metric metric);

// Infinity where nothing was measured that could tell: no ray hits both. measurement: with rays if
// is_of_rays(metric).
double figure_of(Metric metric, const measure::Measurement& measurement);

} // namespace spa::plan
