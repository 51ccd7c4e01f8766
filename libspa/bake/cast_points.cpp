// SPDX-License-Identifier: Apache-2.0
#include "cast_points.h"

#include "order_crossings.h"
#include "sample_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <utility>

namespace spa::bake {
namespace {

struct Found {
    std::uint32_t point;
    std::uint32_t triangle;
    float radius;
    bool front_facing;
};

struct Place {
    TexelIndex at;
    std::uint32_t point;
};

// All places on the map of a point at (x, y), itself first: a triangle at the border may meet only one of
// them within its octant. last: index of the last sample of a row.
struct Aliases {
    std::array<TexelIndex, 4> at;
    unsigned count = 1;
    Aliases(TexelIndex p, std::uint32_t last) : at{p} {
        const bool side = p.x == 0 || p.x == last;
        const bool end = p.y == 0 || p.y == last;
        if (end) at[count++] = {last - p.x, p.y};
        if (side) at[count++] = {p.x, last - p.y};
        if (side && end) at[count++] = {last - p.x, last - p.y};
    }
};

// Points by square bins of the map.
class Bins {
public:
    Bins(const Grid& grid, std::span<const TexelIndex> points) {
        const std::uint32_t last = grid.width - 1;
        while ((last >> shift_) >= most_bins_a_side) ++shift_;
        side_ = (last >> shift_) + 1;
        std::vector<Place> places;
        places.reserve(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Aliases aliases(points[i], last);
            for (unsigned k = 0; k < aliases.count; ++k) places.push_back({aliases.at[k], std::uint32_t(i)});
        }
        first_.assign(std::size_t(side_) * side_ + 1, 0);
        for (const Place& place : places) ++first_[bin_of(place.at) + 1];
        for (std::size_t b = 0; b + 1 < first_.size(); ++b) first_[b + 1] += first_[b];
        places_.resize(places.size());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (const Place& place : places) places_[next[bin_of(place.at)]++] = place;
    }

    // visit(place) for every one in the rectangle.
    template <class Visit>
    void each(const SampleRect& rect, Visit&& visit) const {
        for (std::uint32_t by = rect.y0 >> shift_; by <= rect.y1 >> shift_; ++by) {
            const std::size_t row = std::size_t(by) * side_;
            const std::uint32_t begin = first_[row + (rect.x0 >> shift_)];
            const std::uint32_t end = first_[row + (rect.x1 >> shift_) + 1];
            for (std::uint32_t i = begin; i < end; ++i) {
                const TexelIndex at = places_[i].at;
                if (at.x >= rect.x0 && at.x <= rect.x1 && at.y >= rect.y0 && at.y <= rect.y1)
                    visit(places_[i]);
            }
        }
    }

private:
    static constexpr std::uint32_t most_bins_a_side = 1024;

    [[nodiscard]] std::size_t bin_of(TexelIndex at) const {
        return std::size_t(at.y >> shift_) * side_ + (at.x >> shift_);
    }

    unsigned shift_ = 0;
    std::uint32_t side_ = 0;
    std::vector<std::uint32_t> first_; // of each bin, and the end
    std::vector<Place> places_;
};

} // namespace

PointCaster::PointCaster(const CenteredModel& model, std::uint32_t cells, std::uint32_t steps)
    : model_(model), cells_(cells),
      steps_(steps), grid_{Mapping::octahedral, cells * steps + 1, cells * steps + 1},
      candidates_(grid_, model.positions) {}

PointCrossings PointCaster::cast(std::span<const TexelIndex> points) const {
    const Bins bins(grid_, points);
    const SampleDirections directions(grid_);
    // Of the map's samples, whose footprints alpha is filtered for.
    const Grid samples{Mapping::octahedral, cells_ + 1, cells_ + 1};
    const SampleRays rays(model_, samples);
    const auto& triangles = model_.model->triangles;
    tbb::enumerable_thread_specific<std::vector<Found>> lists;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 1024), [&](const auto& range) {
        std::vector<Found>& list = lists.local();
        std::array<SampleRect, Candidates::max_rects> rects;
        for (auto t = std::uint32_t(range.begin()); t < range.end(); ++t) {
            const std::size_t count = candidates_.find(triangles[t], rects);
            for (std::size_t r = 0; r < count; ++r) {
                bins.each(rects[r], [&](const Place& place) {
                    const RaySetup setup(model_, triangles[t]);
                    RayHit hit;
                    const Vec3d g = directions(place.at.x, place.at.y);
                    if (!setup.visible() || !intersect(setup, g, hit)) return;
                    const TexelIndex sample{place.at.x / steps_, place.at.y / steps_};
                    if (!rays.visible(t, sample, g, hit)) return;
                    list.push_back({place.point, t, float(hit.radius), setup.front_facing});
                });
            }
        }
    });
    std::vector<std::uint64_t> begin(points.size() + 1, 0);
    for (const auto& list : lists)
        for (const Found& f : list) ++begin[std::size_t(f.point) + 1];
    for (std::size_t i = 0; i < points.size(); ++i) begin[i + 1] += begin[i];
    std::vector<Found> found(begin.back());
    {
        std::vector<std::uint64_t> next(begin.begin(), begin.end() - 1);
        for (const auto& list : lists)
            for (const Found& f : list) found[next[f.point]++] = f;
    }
    PointCrossings result;
    std::vector<std::uint32_t> kept(points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            Found* const first = found.data() + begin[i];
            kept[i] = std::uint32_t(order_crossings(first, found.data() + begin[i + 1]) - first);
        }
    });
    result.first.resize(points.size() + 1, 0);
    for (std::size_t i = 0; i < points.size(); ++i) result.first[i + 1] = result.first[i] + kept[i];
    result.crossings.resize(result.first.back());
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::uint32_t k = 0; k < kept[i]; ++k) {
            const Found& f = found[begin[i] + k];
            result.crossings[result.first[i] + k] = {f.radius, f.triangle, {}, {}, f.front_facing};
        }
    return result;
}

} // namespace spa::bake
