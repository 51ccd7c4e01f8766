// SPDX-License-Identifier: Apache-2.0
#include "radial.h"

#include "arena.h"
#include "candidates.h"
#include "intersect_block.h"
#include "order_crossings.h"
#include "progress_meter.h"
#include "sample_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace spa::bake {
namespace {

// Calls found(first sample, radii, count, triangle, front_facing) for pieces of rows: radius 0 where the ray
// misses the triangle. In parallel over triangles; a sample may come twice. begin() makes a `found` for each
// run of triangles.
template <class Begin>
void rasterize(const SampleRays& rays, ProgressMeter& meter, Begin&& begin) {
    const auto& triangles = rays.model.model->triangles;
    const Candidates candidates(rays.grid, rays.model.positions);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 256), [&](const auto& range) {
        if (meter.cancelled()) return;
        const auto found = begin();
        std::array<SampleRect, Candidates::max_rects> rects;
        for (auto i = std::uint32_t(range.begin()); i < range.end(); ++i) {
            const std::size_t count = candidates.find(triangles[i], rects);
            if (count == 0) continue;
            const RaySetup setup(rays.model, triangles[i]);
            if (!setup.visible()) continue;
            const bool opaque = !rays.shader.needs_alpha(i);
            const auto visit = [&](TexelIndex at, double* radius, std::uint32_t length) {
                for (std::uint32_t k = 0; !opaque && k < length; ++k) {
                    if (radius[k] > 0 && !rays.visible(i, {at.x + k, at.y}, setup)) radius[k] = 0;
                }
                found(at, radius, length, i, setup.front_facing);
            };
            for (std::size_t r = 0; r < count; ++r) each_row(setup, rays.directions, rects[r], visit);
        }
        meter.add(range.size());
    });
    meter.throw_if_cancelled();
}

std::size_t sample_count(const Grid& grid) { return std::size_t(grid.width) * grid.height; }

// visit(sample, its texel) for every sample, in parallel.
template <class Visit>
void each_sample(const Grid& grid, Visit&& visit) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, grid.height), [&](const auto& rows) {
        for (std::uint32_t y = rows.begin(); y < rows.end(); ++y) {
            for (std::uint32_t x = 0; x < grid.width; ++x)
                visit(std::size_t(y) * grid.width + x, TexelIndex{x, y});
        }
    });
}

// A map for each thread spares atomic operations, which take longer than all else where triangles are larger
// than samples. Larger maps are not worth their memory.
constexpr std::size_t most_private_samples = std::size_t(1) << 20U;

std::vector<OutermostHit> find_privately(const SampleRays& rays, ProgressMeter& meter) {
    using Hits = std::vector<OutermostHit>;
    tbb::enumerable_thread_specific<Hits> maps(sample_count(rays.grid));
    rasterize(rays, meter, [&] {
        return [row = maps.local().data(), width = rays.grid.width](
                   TexelIndex at, const double* radius, std::uint32_t count, std::uint32_t triangle, bool) {
            keep_outermost_row(radius, count, triangle, row + std::size_t(at.y) * width + at.x);
        };
    });
    Hits result = std::move(maps.local());
    for (const Hits& hits : maps) { // the one that was moved from is empty
        for (std::size_t s = 0; s < hits.size(); ++s) result[s].keep_outermost(hits[s]);
    }
    return result;
}

std::vector<OutermostHit> find_together(const SampleRays& rays, ProgressMeter& meter) {
    std::vector<OutermostHit> hits(sample_count(rays.grid));
    rasterize(rays, meter, [&] {
        return [&](TexelIndex at, const double* radius, std::uint32_t count, std::uint32_t triangle, bool) {
            OutermostHit* const row = hits.data() + std::size_t(at.y) * rays.grid.width + at.x;
            for (std::uint32_t i = 0; i < count; ++i) {
                if (radius[i] > 0) row[i].keep_outermost_atomically({float(radius[i]), triangle});
            }
        };
    });
    return hits;
}

std::vector<OutermostHit> find_outermost(const SampleRays& rays, ProgressMeter& meter) {
    std::vector<OutermostHit> hits = sample_count(rays.grid) <= most_private_samples
                                         ? find_privately(rays, meter)
                                         : find_together(rays, meter);
    const auto hit_at = [&](TexelIndex at) -> OutermostHit& {
        return hits[std::size_t(at.y) * rays.grid.width + at.x];
    };
    const auto each_border_sample = [&](auto&& visit) {
        for (std::uint32_t x = 0; x < rays.grid.width; ++x) {
            visit(TexelIndex{x, 0});
            visit(TexelIndex{x, rays.grid.height - 1});
        }
        for (std::uint32_t y = 0; y < rays.grid.height; ++y) {
            visit(TexelIndex{0, y});
            visit(TexelIndex{rays.grid.width - 1, y});
        }
    };
    each_border_sample([&](TexelIndex at) { hits[rays.owner(at)].keep_outermost(hit_at(at)); });
    each_border_sample([&](TexelIndex at) { hit_at(at) = hits[rays.owner(at)]; });
    return hits;
}

CrossingGrid cast_outermost(const SampleRays& rays, ProgressMeter& meter) {
    const std::vector<OutermostHit> hits = find_outermost(rays, meter);
    CrossingGrid result;
    result.grid = rays.grid;
    result.first.resize(hits.size() + 1, 0);
    for (std::size_t s = 0; s < hits.size(); ++s) {
        result.first[s + 1] = result.first[s] + (hits[s].empty() ? 0 : 1);
    }
    result.crossings.resize(result.first.back());
    each_sample(rays.grid, [&](std::size_t s, TexelIndex at) {
        if (!hits[s].empty()) result.crossings[result.first[s]] = rays.shade(at, hits[s].triangle());
    });
    return result;
}

struct Found {
    std::uint32_t sample;
    std::uint32_t triangle;
    float radius;
    bool front_facing;
};

CrossingGrid cast_all(const SampleRays& rays, ProgressMeter& meter) {
    tbb::enumerable_thread_specific<std::vector<Found>> lists;
    rasterize(rays, meter, [&] {
        return [&list = lists.local(), &rays](TexelIndex at, const double* radius, std::uint32_t count,
                                              std::uint32_t triangle, bool front_facing) {
            for (std::uint32_t i = 0; i < count; ++i) {
                if (!(radius[i] > 0)) continue;
                list.push_back(
                    {std::uint32_t(rays.owner({at.x + i, at.y})), triangle, float(radius[i]), front_facing});
            }
        };
    });
    const std::size_t samples = sample_count(rays.grid);
    std::vector<std::uint64_t> begin(samples + 1, 0);
    for (const auto& list : lists) {
        for (const Found& f : list) ++begin[f.sample + 1U];
    }
    for (std::size_t s = 0; s < samples; ++s) begin[s + 1] += begin[s];
    std::vector<Found> found(begin.back());
    {
        std::vector<std::uint64_t> next(begin.begin(), begin.end() - 1);
        for (auto& list : lists) {
            for (const Found& f : list) found[next[f.sample]++] = f;
            std::vector<Found>().swap(list);
        }
    }
    std::vector<std::uint32_t> kept(samples);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples, 4096), [&](const auto& range) {
        for (std::size_t s = range.begin(); s < range.end(); ++s) {
            Found* const first = found.data() + begin[s];
            kept[s] = std::uint32_t(order_crossings(first, found.data() + begin[s + 1]) - first);
        }
    });
    CrossingGrid result;
    result.grid = rays.grid;
    result.first.resize(samples + 1, 0);
    for (std::size_t s = 0; s < samples; ++s)
        result.first[s + 1] = result.first[s] + kept[rays.owner(rays.texel(s))];
    result.crossings.resize(result.first.back());
    each_sample(rays.grid, [&](std::size_t s, TexelIndex at) {
        const Found* const first = found.data() + begin[rays.owner(at)];
        for (std::uint64_t k = result.first[s]; k < result.first[s + 1]; ++k)
            result.crossings[k] = rays.shade(at, first[k - result.first[s]].triangle);
    });
    return result;
}

} // namespace

std::vector<OutermostHit> find_outermost(const CenteredModel& model, const Grid& grid,
                                         const CastOptions& options) {
    const SampleRays rays(model, grid);
    ProgressMeter meter(options.progress, model.model->triangles.size());
    std::vector<OutermostHit> result;
    tbb::task_arena arena(arena_concurrency(options.threads));
    arena.execute([&] { result = find_outermost(rays, meter); });
    return result;
}

CrossingGrid cast_radial(const CenteredModel& model, const Grid& grid, const CastOptions& options) {
    const SampleRays rays(model, grid);
    ProgressMeter meter(options.progress, model.model->triangles.size());
    CrossingGrid result;
    tbb::task_arena arena(arena_concurrency(options.threads));
    arena.execute(
        [&] { result = options.outermost_only ? cast_outermost(rays, meter) : cast_all(rays, meter); });
    return result;
}

} // namespace spa::bake
