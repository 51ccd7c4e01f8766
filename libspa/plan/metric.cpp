// SPDX-License-Identifier: Apache-2.0
#include "metric.h"

#include <algorithm>
#include <array>
#include <limits>

namespace spa::plan {

std::span<const Metric> metrics() {
    static constexpr std::array all{Metric::p95_dt,     Metric::p99_dt,      Metric::mean_dt,
                                    Metric::false_hits, Metric::missed_hits, Metric::p95_surface,
                                    Metric::hausdorff};
    return all;
}

const char* name(Metric metric) {
    switch (metric) {
    case Metric::p95_dt: return "p95-dt";
    case Metric::p99_dt: return "p99-dt";
    case Metric::mean_dt: return "mean-dt";
    case Metric::false_hits: return "false-hits";
    case Metric::missed_hits: return "missed-hits";
    case Metric::p95_surface: return "p95-surface";
    case Metric::hausdorff: break;
    }
    return "hausdorff";
}

bool is_of_rays(Metric metric) { return metric != Metric::p95_surface && metric != Metric::hausdorff; }

bool is_share(Metric metric) { return metric == Metric::false_hits || metric == Metric::missed_hits; }

double figure_of(Metric metric, const measure::Measurement& m) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (metric == Metric::p95_surface) return std::max(m.texel_distance.p95, m.surface_distance.p95);
    if (metric == Metric::hausdorff) return m.hausdorff();
    if (!m.rays || m.rays->errors.rays() == 0) return unknown;
    if (metric == Metric::false_hits) return m.rays->false_hits();
    if (metric == Metric::missed_hits) return m.rays->missed_hits();
    const measure::Distribution& dt = m.rays->errors.distance;
    if (dt.count == 0) return unknown;
    return metric == Metric::mean_dt ? dt.mean : metric == Metric::p99_dt ? dt.p99 : dt.p95;
}

} // namespace spa::plan
