// SPDX-License-Identifier: Apache-2.0
#include "bench_bake.h"

#include "../bake/arena.h"
#include "../bake/bake.h"
#include "../bake/center.h"
#include "../bake/radial.h"
#include "../bake/sample_rays.h"
#include "../trace/triangle_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <sched.h>
#include <tuple>

namespace spa::measure {
namespace {

template <class Work>
double seconds_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Keeps this thread, and those that it starts meanwhile, on the first `count` of its processors.
class ProcessorLimit {
public:
    explicit ProcessorLimit(unsigned count) {
        if (sched_getaffinity(0, sizeof before_, &before_) != 0) return;
        cpu_set_t limited;
        CPU_ZERO(&limited);
        for (int cpu = 0; cpu < CPU_SETSIZE && count > 0; ++cpu) {
            if (!CPU_ISSET(cpu, &before_)) continue;
            CPU_SET(cpu, &limited);
            --count;
        }
        changed_ = sched_setaffinity(0, sizeof limited, &limited) == 0;
    }
    ~ProcessorLimit() {
        if (changed_) sched_setaffinity(0, sizeof before_, &before_);
    }
    ProcessorLimit(const ProcessorLimit&) = delete;
    ProcessorLimit& operator=(const ProcessorLimit&) = delete;

private:
    cpu_set_t before_{};
    bool changed_ = false;
};

// What find_outermost finds, by one ray a sample from outside the bounding sphere to its centre. Float, and
// nothing checks the hits again: as fast as Embree can. Opaque models only. In the caller's arena.
std::vector<bake::OutermostHit> trace_outermost(const bake::SampleRays& rays,
                                                const trace::TriangleScene& scene) {
    constexpr float start = 1.001F; // beyond the unit sphere by more than rounding
    std::vector<bake::OutermostHit> hits(std::size_t(rays.grid.width) * rays.grid.height);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, rays.grid.height), [&](const auto& rows) {
        for (std::uint32_t y = rows.begin(); y < rows.end(); ++y) {
            for (std::uint32_t x = 0; x < rays.grid.width; ++x) {
                const Vec3f u = to_float(normalize(rays.directions(x, y)));
                trace::TriangleHit hit;
                if (scene.closest_hit(u * start, -u, start, hit))
                    hits[std::size_t(y) * rays.grid.width + x] = {std::max(start - hit.t, 0.0F),
                                                                  hit.triangle};
            }
        }
    });
    return hits;
}

// Normals and colours as the radial baker adds them.
bake::CrossingGrid shade(const bake::SampleRays& rays, const std::vector<bake::OutermostHit>& hits) {
    bake::CrossingGrid result;
    result.grid = rays.grid;
    result.first.resize(hits.size() + 1, 0);
    for (std::size_t s = 0; s < hits.size(); ++s)
        result.first[s + 1] = result.first[s] + (hits[s].empty() ? 0 : 1);
    result.crossings.resize(result.first.back());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, rays.grid.height), [&](const auto& rows) {
        for (std::uint32_t y = rows.begin(); y < rows.end(); ++y) {
            for (std::uint32_t x = 0; x < rays.grid.width; ++x) {
                const std::size_t s = std::size_t(y) * rays.grid.width + x;
                if (!hits[s].empty())
                    result.crossings[result.first[s]] = rays.shade({x, y}, hits[s].triangle());
            }
        }
    });
    return result;
}

// Evenly spread views: the samples of a coarse lat-long map.
constexpr Grid few_views{Mapping::latlong, 4, 2};
Grid more_views(unsigned doublings) { return {Mapping::latlong, 8U << doublings, 4U << doublings}; }
std::uint64_t sample_count(const Grid& grid) { return std::uint64_t(grid.width) * grid.height; }

// All the seconds that were measured, by what they are of.
enum class Part : std::uint8_t { crossings, hits, build };
struct Measured {
    std::map<std::tuple<Caster, unsigned, Part>, std::vector<double>> casts;
    std::map<std::tuple<unsigned, std::uint32_t>, std::vector<double>> bakes;
};

class Bench {
public:
    Bench(const Model& model, const BenchOptions& options) : model_(model), options_(options) {
        bool moved = false;
        const PartFrame frame = make_part_frame(model, bounds_center(model, moved), false);
        centered_ = bake::center_model(model, frame);
    }

    BakeBenchmark run() {
        for (unsigned run = 0; run < options_.runs; ++run) {
            for (const unsigned threads : options_.threads) {
                for (const Caster caster : options_.casters) {
                    measure(caster, threads);
                    ++done_;
                    const double total =
                        double(options_.runs) * double(options_.threads.size() * options_.casters.size());
                    if (options_.progress) options_.progress(double(done_) / total);
                }
            }
        }
        return result();
    }

private:
    void measure(Caster caster, unsigned threads) {
        switch (caster) {
        case Caster::radial: return measure_radial(threads);
        case Caster::embree: return measure_embree(threads);
        case Caster::orbit: return measure_orbit(threads);
        case Caster::naive: return measure_naive(threads);
        }
    }

    void add(Caster caster, unsigned threads, Part part, double seconds) {
        measured_.casts[{caster, threads, part}].push_back(seconds);
    }

    void measure_radial(unsigned threads) {
        const bake::CastOptions cast{true, threads, {}};
        add(Caster::radial, threads, Part::hits,
            seconds_of([&] { (void)bake::find_outermost(centered_, options_.grid, cast); }));
        add(Caster::radial, threads, Part::crossings,
            seconds_of([&] { (void)bake::cast_radial(centered_, options_.grid, cast); }));
        for (const std::uint32_t layers : {1U, 2U}) {
            bake::Options bake;
            bake.grid = bake.color_grid = options_.grid;
            bake.layers = layers;
            bake.threads = threads;
            measured_.bakes[{threads, layers}].push_back(
                seconds_of([&] { (void)bake::bake_model(model_, bake); }));
        }
    }

    void measure_embree(unsigned threads) {
        tbb::task_arena arena(bake::arena_concurrency(threads));
        arena.execute([&] {
            std::optional<trace::TriangleScene> scene;
            const double build = seconds_of([&] { scene.emplace(centered_.positions, model_.triangles); });
            std::vector<bake::OutermostHit> hits;
            const double trace = seconds_of(
                [&] { hits = trace_outermost(bake::SampleRays(centered_, options_.grid), *scene); });
            const double shading =
                seconds_of([&] { (void)shade(bake::SampleRays(centered_, options_.grid), hits); });
            add(Caster::embree, threads, Part::build, build);
            add(Caster::embree, threads, Part::hits, build + trace);
            add(Caster::embree, threads, Part::crossings, build + trace + shading);
        });
    }

    double orbit_seconds(const bake::GlContext& context, const Grid& grid, bool naive, unsigned threads) {
        const bake::CastOptions cast{true, threads, {}};
        return seconds_of([&] { (void)bake::cast_orbit(context, centered_, grid, naive, cast); });
    }

    void measure_orbit(unsigned threads) {
        const ProcessorLimit limit(threads);
        const auto context = bake::make_gl_context(options_.gl);
        add(Caster::orbit, threads, Part::crossings, orbit_seconds(*context, options_.grid, false, threads));
    }

    // Two numbers of views tell what a view costs apart from what happens once, such as the upload.
    void measure_naive(unsigned threads) {
        const ProcessorLimit limit(threads);
        const auto context = bake::make_gl_context(options_.gl);
        (void)orbit_seconds(*context, few_views, true, threads); // compiles the shaders
        const double few = orbit_seconds(*context, few_views, true, threads);
        // The first run decides for all: enough views to take a second, unless that is all of them.
        double more = orbit_seconds(*context, more_views(doublings_), true, threads);
        while (!views_chosen_ && more < 1.0 && sample_count(more_views(doublings_ + 1)) <= most_views()) {
            more = orbit_seconds(*context, more_views(++doublings_), true, threads);
        }
        views_chosen_ = true;
        const double timed = double(sample_count(more_views(doublings_)));
        const double once = double(sample_count(few_views));
        // On a tiny map the larger number may have been the quicker one, by chance.
        const double a_view = std::max(0.0, more - few) / (timed - once);
        add(Caster::naive, threads, Part::crossings,
            few + a_view * (double(sample_count(options_.grid)) - once));
    }
    [[nodiscard]] std::uint64_t most_views() const {
        return std::max(sample_count(more_views(0)), sample_count(options_.grid) / 4);
    }

    BakeBenchmark result() {
        BakeBenchmark result;
        result.grid = options_.grid;
        for (const unsigned threads : options_.threads) {
            for (const Caster caster : options_.casters) {
                const auto spread = [&](Part part) -> std::optional<Spread> {
                    const auto found = measured_.casts.find({caster, threads, part});
                    if (found == measured_.casts.end()) return {};
                    return spread_of(found->second);
                };
                result.casts.push_back({caster, threads, spread(Part::crossings).value_or(Spread{}),
                                        spread(Part::hits), spread(Part::build),
                                        caster == Caster::naive ? sample_count(more_views(doublings_)) : 0});
            }
        }
        for (const auto& [key, values] : measured_.bakes)
            result.bakes.push_back({std::get<0>(key), std::get<1>(key), spread_of(values)});
        return result;
    }

    const Model& model_;
    const BenchOptions& options_;
    bake::CenteredModel centered_;
    Measured measured_;
    unsigned doublings_ = 0;
    bool views_chosen_ = false;
    unsigned done_ = 0;
};

} // namespace

Spread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    const double median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
    return {median, values.front(), values.back(), unsigned(values.size())};
}

const char* name(Caster caster) {
    switch (caster) {
    case Caster::radial: return "radial";
    case Caster::embree: return "embree";
    case Caster::orbit: return "orbit";
    case Caster::naive: break;
    }
    return "naive";
}

BakeBenchmark bench_bake(const Model& model, const BenchOptions& options) {
    return Bench(model, options).run();
}

} // namespace spa::measure
