// SPDX-License-Identifier: Apache-2.0
#include "intervals.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numbers>
#include <span>

namespace spa::bake {
namespace {

struct Interval {
    SurfacePoint outer;
    SurfacePoint inner; // radius 0: reaches the centre
};

SurfacePoint point(const Crossing& crossing, bool turn) {
    return {crossing.radius, crossing.triangle, turn ? -crossing.normal : crossing.normal, crossing.color,
            false};
}

// The shell's normals face away from it on both sides, whichever way the triangle is wound.
Interval thin_shell(const Crossing& crossing) {
    Interval shell;
    shell.outer = point(crossing, !crossing.front_facing);
    shell.inner = point(crossing, crossing.front_facing);
    shell.inner.placed = true;
    // Half the radius if the shell is at the centre: the inner end must stay a surface.
    shell.inner.radius = std::max(crossing.radius - shell_thickness, crossing.radius / 2);
    return shell;
}

class Pairing {
public:
    Pairing(const Components& components, const Orientation& orientation)
        : components_(components), orientation_(orientation) {}

    // The intervals of one sample, outermost first, disjoint. Valid until the next call.
    std::span<const Interval> operator()(std::span<const Crossing> crossings, bool& thin) {
        intervals_.clear();
        open_.clear();
        thin = false;
        for (const Crossing& crossing : crossings) {
            const std::uint32_t component = components_.of_triangle[crossing.triangle];
            const bool flipped = orientation_.flipped[component];
            if (crossing.front_facing != flipped) {
                open_.push_back(&crossing);
                continue;
            }
            const auto entry = std::find_if(open_.rbegin(), open_.rend(), [&](const Crossing* c) {
                return components_.of_triangle[c->triangle] == component;
            });
            if (entry == open_.rend()) {
                intervals_.push_back(thin_shell(crossing));
                thin = true;
            } else {
                intervals_.push_back({point(**entry, flipped), point(crossing, flipped)});
                open_.erase(std::next(entry).base());
            }
        }
        for (const Crossing* crossing : open_) {
            const std::uint32_t component = components_.of_triangle[crossing->triangle];
            if (orientation_.solid[component]) {
                intervals_.push_back({point(*crossing, orientation_.flipped[component]), {}});
            } else {
                intervals_.push_back(thin_shell(*crossing));
                thin = true;
            }
        }
        unite();
        return intervals_;
    }

private:
    void unite() {
        std::stable_sort(intervals_.begin(), intervals_.end(), [](const Interval& a, const Interval& b) {
            return a.outer.radius > b.outer.radius;
        });
        std::size_t count = 0;
        for (const Interval& next : intervals_) {
            if (count == 0 || next.outer.radius < intervals_[count - 1].inner.radius - merge_distance) {
                intervals_[count++] = next;
            } else if (next.inner.radius < intervals_[count - 1].inner.radius) {
                intervals_[count - 1].inner = next.inner;
            }
        }
        intervals_.resize(count);
    }

    const Components& components_;
    const Orientation& orientation_;
    std::vector<Interval> intervals_;
    std::vector<const Crossing*> open_;
};

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
            const double sign = c.front_facing ? 1 : -1;
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
        result.surfaces[0][s] = point(c, !c.front_facing);
    }
    return result;
}

} // namespace spa::bake
