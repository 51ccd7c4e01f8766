// SPDX-License-Identifier: Apache-2.0
#include "bench_trace.h"

#include "method_set.h"
#include "ray_truth.h"
#include "stopwatch.h"

#include "../bake/center.h"
#include "../trace/triangle_scene.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace spa::measure {
namespace {

constexpr std::uint32_t band_cells = 128; // whose texels the band of methods without texels is made of
double band_width(std::uint32_t cells) { return 2 * (2.0 / (cells == 0 ? band_cells : cells)); }

class Bench {
public:
    Bench(const Model& model, const TraceBenchOptions& options) : model_(model), options_(options) {
        bool moved = false;
        const PartFrame frame = make_part_frame(model, bounds_center(model, moved), false);
        centered_ = bake::center_model(model, frame);
        scene_.emplace(centered_.positions, model.triangles);
        truth_.emplace(centered_, *scene_);
    }

    TraceBenchmark run() {
        constexpr double prepare_share = 0.2;
        set_ = make_methods(model_, centered_, options_, [&](double share, const std::string& what) {
            step(prepare_share * share, what);
        });
        for (std::size_t i = 0; i < options_.sets.size(); ++i) {
            const double share = (1 - prepare_share) / double(options_.sets.size());
            measure_set(options_.sets[i], prepare_share + share * double(i), share);
        }
        TraceBenchmark result;
        result.vertices = model_.positions.size();
        result.triangles = model_.triangles.size();
        result.simplify_seconds = set_.simplify_seconds;
        result.methods = std::move(set_.reports);
        std::stable_sort(result.methods.begin(), result.methods.end(),
                         [](const auto& a, const auto& b) { return a.family < b.family; });
        return result;
    }

private:
    void step(double share, const std::string& what) const {
        if (options_.progress && !options_.progress(share, what)) throw bake::Cancelled{};
    }

    void measure_set(RaySet set, double begin, double length) {
        step(begin, std::string("errors of ") + name(set) + " rays");
        RayBatch batch(set, make_rays(set, options_.rays, bench_seed, centered_.positions, model_.triangles));
        if (batch.rays().empty()) return;
        const std::vector<RayAnswer> truth = truth_->trace(batch.rays());
        std::map<double, std::vector<std::uint8_t>> bands; // by width
        for (std::size_t i = 0; i < set_.methods.size(); ++i) {
            TraceMethod& method = *set_.methods[i];
            method.prepare(batch);
            SetErrors errors{set, band_width(method.cells), {}};
            std::vector<std::uint8_t>& band = bands[errors.band_width];
            if (band.empty()) band = truth_->silhouette_band(batch.rays(), truth, float(errors.band_width));
            errors.errors = batch.occlusion()
                                ? compare_occlusion(truth, blocked_of(method, batch), band)
                                : compare_answers(batch.rays(), truth, answers_of(method, batch), band);
            set_.reports[i].errors.push_back(errors);
        }
        if (set == RaySet::chords && options_.parts) measure_parts(batch, truth);
        time_set(batch, begin + length * 0.3, length * 0.7);
    }

    void measure_parts(RayBatch& batch, const std::vector<RayAnswer>& truth) {
        ErrorPartsMeter meter(model_, batch, truth);
        for (std::size_t i = 0; i < set_.methods.size(); ++i)
            if (set_.methods[i]->family == Family::projective)
                set_.reports[i].parts = meter.measure(*set_.methods[i]);
    }

    void time_set(RayBatch& batch, double begin, double length) {
        std::map<std::tuple<std::size_t, unsigned, CallKind>, std::vector<double>> measured;
        for (unsigned run = 0; run < options_.runs; ++run) {
            step(begin + length * run / options_.runs,
                 std::string("times of ") + name(batch.set()) + " rays");
            for (std::size_t i = 0; i < set_.methods.size(); ++i) {
                for (const CallKind kind : {CallKind::single, CallKind::stream}) {
                    if (kind == CallKind::stream && !set_.methods[i]->has_stream()) continue;
                    for (const unsigned threads : threads_of(batch.set()))
                        measured[{i, threads, kind}].push_back(
                            nanoseconds(*set_.methods[i], batch, kind, threads));
                }
            }
        }
        for (const auto& [key, values] : measured) {
            const auto& [i, threads, kind] = key;
            set_.reports[i].timings.push_back({batch.set(), threads, kind,
                                               set_.methods[i]->call_name(batch.set(), kind),
                                               spread_of(values)});
        }
    }

    [[nodiscard]] std::span<const unsigned> threads_of(RaySet set) const {
        const std::span<const unsigned> all = options_.threads;
        return set == RaySet::chords ? all : all.first(1);
    }

    static double nanoseconds(const TraceMethod& method, RayBatch& batch, CallKind kind, unsigned threads) {
        if (threads == 1) return one_thread_ns(method, batch, kind);
        method.reset(batch, kind);
        double seconds = 0;
        tbb::task_arena arena{int(threads)};
        arena.execute([&] { seconds = seconds_of([&] { trace_all(method, batch, kind); }); });
        return seconds * 1e9 / double(batch.rays().size());
    }

    const Model& model_;
    const TraceBenchOptions& options_;
    bake::CenteredModel centered_;
    std::optional<trace::TriangleScene> scene_;
    std::optional<RayTruth> truth_;
    MethodSet set_;
};

} // namespace

const SetErrors* MethodReport::errors_of(RaySet set) const {
    const auto found =
        std::find_if(errors.begin(), errors.end(), [&](const auto& e) { return e.set == set; });
    return found == errors.end() ? nullptr : &*found;
}

const TraceTiming* MethodReport::timing(RaySet set, unsigned threads, CallKind kind) const {
    const auto found = std::find_if(timings.begin(), timings.end(), [&](const TraceTiming& t) {
        return t.set == set && t.threads == threads && t.kind == kind;
    });
    return found == timings.end() ? nullptr : &*found;
}

const TraceTiming* MethodReport::fastest(RaySet set, unsigned threads) const {
    const TraceTiming* const single = timing(set, threads, CallKind::single);
    const TraceTiming* const stream = timing(set, threads, CallKind::stream);
    if (single == nullptr || stream == nullptr) return single == nullptr ? stream : single;
    return stream->ns.median < single->ns.median ? stream : single;
}

const MethodReport* TraceBenchmark::find(const std::string& name) const {
    const auto found =
        std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; });
    return found == methods.end() ? nullptr : &*found;
}

TraceBenchmark bench_trace(const Model& model, const TraceBenchOptions& options) {
    return Bench(model, options).run();
}

} // namespace spa::measure
