// SPDX-License-Identifier: Apache-2.0
#include "intervals.h"

#include "pairing.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numbers>
#include <span>

namespace spa::bake {
namespace {

std::size_t sample_count(const Grid& grid) { return std::size_t(grid.width) * grid.height; }

} // namespace

Orientation orient_components(const CrossingGrid& crossings, const Components& components) {
    std::vector<double> volume(components.count, 0);
    std::vector<double> magnitude(components.count, 0);
    std::vector<double> winding(components.count, 0);
    Orientation result;
    result.seen.resize(components.count, false);
    for (std::size_t s = 0; s + 1 < crossings.first.size(); ++s) {
        if (crossings.first[s] == crossings.first[s + 1]) continue;
        const TexelIndex texel{std::uint32_t(s % crossings.grid.width),
                               std::uint32_t(s / crossings.grid.width)};
        const double angle = solid_angle(crossings.grid, texel);
        for (std::uint64_t k = crossings.first[s]; k < crossings.first[s + 1]; ++k) {
            const Crossing& c = crossings.crossings[k];
            const std::uint32_t component = components.of_triangle[c.triangle];
            const double sign = c.front_facing != components.is_turned(c.triangle) ? 1 : -1;
            const double cone = angle * double(c.radius) * c.radius * c.radius / 3;
            volume[component] += sign * cone;
            magnitude[component] += cone;
            winding[component] += sign * angle / (4 * std::numbers::pi);
            result.seen[component] = true;
        }
    }
    result.flipped.resize(components.count);
    result.solid.resize(components.count);
    for (std::uint32_t c = 0; c < components.count; ++c) {
        // A double sheet has no volume but rounding: it stays as it is wound.
        result.flipped[c] = volume[c] < -1e-6 * magnitude[c];
        result.solid[c] = (result.flipped[c] ? -winding[c] : winding[c]) > solid_winding;
    }
    return result;
}

SurfaceGrid pair_intervals(const CrossingGrid& crossings, const Components& components,
                           const Orientation& orientation, std::uint32_t layers,
                           IntervalStatistics& statistics) {
    const std::size_t samples = sample_count(crossings.grid);
    SurfaceGrid result;
    result.grid = crossings.grid;
    result.surfaces.resize(2 * std::size_t(layers), std::vector<SurfacePoint>(samples));
    std::atomic<std::uint64_t> thin_samples = 0;
    std::atomic<std::uint64_t> truncated_samples = 0;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples, 1024), [&](const auto& range) {
        Pairing pair(components, orientation);
        for (std::size_t s = range.begin(); s < range.end(); ++s) {
            bool thin = false;
            const auto intervals = pair({crossings.crossings.data() + crossings.first[s],
                                         std::size_t(crossings.first[s + 1] - crossings.first[s])},
                                        thin);
            if (thin) ++thin_samples;
            if (intervals.size() > layers) ++truncated_samples;
            for (std::size_t k = 0; k < std::min<std::size_t>(intervals.size(), layers); ++k) {
                result.surfaces[2 * k][s] = intervals[k].outer;
                result.surfaces[2 * k + 1][s] = intervals[k].inner;
            }
        }
    });
    statistics = {thin_samples, truncated_samples};
    return result;
}

SurfaceGrid outermost_surface(const CrossingGrid& crossings) {
    const std::size_t samples = sample_count(crossings.grid);
    SurfaceGrid result;
    result.grid = crossings.grid;
    result.surfaces.resize(1, std::vector<SurfacePoint>(samples));
    for (std::size_t s = 0; s < samples; ++s) {
        if (crossings.first[s] == crossings.first[s + 1]) continue;
        const Crossing& c = crossings.crossings[crossings.first[s]];
        result.surfaces[0][s] = surface_point(c, !c.front_facing);
    }
    return result;
}

} // namespace spa::bake
