// SPDX-License-Identifier: Apache-2.0
#include "bench_trace.h"

#include "lods.h"
#include "map_surface.h"
#include "ray_truth.h"

#include "../bake/arena.h"
#include "../bake/bake.h"
#include "../bake/center.h"
#include "../trace/triangle_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <tuple>

namespace spa::measure {
namespace {

template <class Work>
double seconds_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Of one thread's own time where the system tells it: what else the machine does then costs a little cache,
// but not whole slices of time.
template <class Work>
double thread_seconds_of(Work&& work) {
#ifdef CLOCK_THREAD_CPUTIME_ID
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
    };
    const double start = now();
    work();
    return now() - start;
#else
    return seconds_of(work);
#endif
}

constexpr std::uint64_t seed = 20240501;
constexpr std::uint32_t band_cells = 128; // whose texels the band of methods without texels is made of
constexpr std::size_t chunk = 4096;       // rays that a thread takes at a time

double band_width(std::uint32_t cells) { return 2 * (2.0 / (cells == 0 ? band_cells : cells)); }

void trace_all(const TraceMethod& method, RayBatch& batch, CallKind kind) {
    const std::size_t count = batch.rays().size();
    tbb::parallel_for(std::size_t(0), (count + chunk - 1) / chunk, [&](std::size_t i) {
        method.trace(batch, kind, i * chunk, std::min(count, (i + 1) * chunk));
    });
}

CallKind best_kind(const TraceMethod& method) {
    return method.has_stream() ? CallKind::stream : CallKind::single;
}

std::vector<RayAnswer> answers_of(const TraceMethod& method, RayBatch& batch) {
    const CallKind kind = best_kind(method);
    method.reset(batch, kind);
    trace_all(method, batch, kind);
    return method.answers(batch, kind);
}

// The surface of a map's outermost depths, in its frame, without triangles that have no area.
MapSurface outermost_surface(const Part& part, bool& complete) {
    const ImageView& depth = part.layers.front().outer.depth;
    std::vector<double> depths;
    for (std::uint32_t y = 0; y < depth.height; ++y)
        for (std::uint32_t x = 0; x < depth.width; ++x)
            depths.push_back(double(decode_depth(depth.format, depth.at(x, y))));
    complete = std::all_of(depths.begin(), depths.end(), [](double d) { return d > 0; });
    MapSurface surface;
    append_surface({part.mapping, depth.width, depth.height}, depths, Mat3{}, surface);
    std::erase_if(surface.triangles, [](const Triangle& t) {
        return t.vertex[0] == t.vertex[1] || t.vertex[1] == t.vertex[2] || t.vertex[2] == t.vertex[0];
    });
    return surface;
}

class Bench {
public:
    Bench(const Model& model, const TraceBenchOptions& options) : model_(model), options_(options) {
        bool moved = false;
        const PartFrame frame = make_part_frame(model, bounds_center(model, moved), false);
        centered_ = bake::center_model(model, frame);
        scene_.emplace(centered_.positions, model.triangles);
        truth_.emplace(centered_, *scene_);
        result_.vertices = model.positions.size();
        result_.triangles = model.triangles.size();
    }

    TraceBenchmark run() {
        make_methods();
        for (std::size_t i = 0; i < options_.sets.size(); ++i) {
            const double share = double(i) / double(options_.sets.size());
            measure_set(options_.sets[i], prepare_share + (1 - prepare_share) * share,
                        (1 - prepare_share) / double(options_.sets.size()));
        }
        std::stable_sort(result_.methods.begin(), result_.methods.end(),
                         [](const auto& a, const auto& b) { return a.family < b.family; });
        return std::move(result_);
    }

private:
    static constexpr double prepare_share = 0.2;

    void step(double share, const std::string& what) const {
        if (options_.progress && !options_.progress(share, what)) throw bake::Cancelled{};
    }

    [[nodiscard]] bool wants(Family family) const {
        return std::find(options_.families.begin(), options_.families.end(), family) !=
               options_.families.end();
    }

    void add(std::unique_ptr<TraceMethod> method, const std::string& name, MethodReport report) {
        method->name = name;
        report.name = name;
        report.family = method->family;
        report.cells = method->cells;
        report.layers = method->layers;
        report.tests = method->tests;
        report.triangles = method->triangles;
        report.target_error = method->target_error;
        report.bytes = method->bytes;
        methods_.push_back(std::move(method));
        result_.methods.push_back(std::move(report));
    }

    [[nodiscard]] static bake::Options bake_options(const Grid& grid, std::uint32_t layers,
                                                    ElementFormat depth) {
        bake::Options bake;
        bake.grid = bake.color_grid = grid;
        bake.layers = layers;
        bake.depth = depth;
        return bake;
    }
    [[nodiscard]] bake::OwnedMap bake(std::uint32_t cells, std::uint32_t layers, ElementFormat depth) const {
        const Grid grid{Mapping::octahedral, cells + 1, cells + 1};
        return bake::bake_model(model_, bake_options(grid, layers, depth)).map;
    }

    void make_methods() {
        if (wants(Family::fan) || wants(Family::march)) make_paper_methods();
        if (wants(Family::projective) || wants(Family::surface)) make_maps();
        step(prepare_share * 0.5, "building Embree's hierarchies");
        if (wants(Family::mesh)) make_mesh();
        if (wants(Family::lod)) make_lods();
    }

    std::optional<FileTrip> through_file(const SphericalMap& map) const {
        if (!options_.through_file) return {};
        const auto rays = make_rays(RaySet::chords, 1, seed, {}, {});
        return options_.through_file(map, rays.front(), options_.runs);
    }

    // The paper's map: latlong, 640 x 480, a byte a depth.
    void make_paper_methods() {
        bake::Options paper = bake_options({Mapping::latlong, 640, 480}, 1, ElementFormat::u8);
        paper.normals = ElementFormat::rgb8;
        const bake::OwnedMap map = bake::bake_model(model_, paper).map;
        const Part& part = map.map.parts.front();
        MethodReport report;
        report.file = through_file(map.map);
        if (wants(Family::fan)) {
            for (const std::uint32_t tests : options_.tests)
                add(map_method(Family::fan, part, 1, tests),
                    "fan " + (tests == 0 ? "N(d2)" : std::to_string(tests)), report);
        }
        if (!wants(Family::march)) return;
        const bake::OwnedMap fine =
            bake::bake_model(model_, bake_options(paper.grid, 1, ElementFormat::u16)).map;
        report.file = through_file(fine.map);
        add(map_method(Family::march, fine.map.parts.front(), 1, 0), "march", report);
    }

    void make_maps() {
        std::size_t done = 0;
        const std::size_t all = options_.cells.size() * options_.layers.size();
        for (const std::uint32_t cells : options_.cells) {
            for (const std::uint32_t layers : options_.layers) {
                step(prepare_share * 0.5 * double(done++) / double(all), "baking");
                const bake::OwnedMap map = bake(cells, layers, ElementFormat::u16);
                const Part& part = map.map.parts.front();
                if (wants(Family::projective)) {
                    MethodReport report;
                    report.file = through_file(map.map);
                    add(map_method(Family::projective, part, layers, 0),
                        "projective " + std::to_string(cells) + "x" + std::to_string(layers),
                        std::move(report));
                }
                if (wants(Family::surface) && layers == options_.layers.front()) make_surface(part, cells);
            }
        }
    }

    std::unique_ptr<TraceMethod> on_one_thread(Family family, std::span<const Vec3f> positions,
                                               std::span<const Vec3f> normals,
                                               std::span<const Triangle> triangles, MethodReport& report) {
        std::unique_ptr<TraceMethod> method;
        double seconds = 0;
        tbb::task_arena arena(1);
        arena.execute([&] { method = triangle_method(family, positions, normals, triangles, seconds); });
        report.build_seconds = seconds;
        return method;
    }

    void make_surface(const Part& part, std::uint32_t cells) {
        bool complete = false;
        const MapSurface surface = outermost_surface(part, complete);
        MethodReport report;
        auto method = on_one_thread(Family::surface, surface.positions, {}, surface.triangles, report);
        method->cells = cells;
        add(std::move(method), "surface " + std::to_string(cells), std::move(report));
    }

    void make_mesh() {
        MethodReport report;
        double seconds = 0;
        (void)triangle_method(Family::mesh, centered_.positions, {}, model_.triangles, seconds);
        report.build_seconds_cores = seconds;
        add(on_one_thread(Family::mesh, centered_.positions, centered_.normals, model_.triangles, report),
            "mesh", std::move(report));
    }

    void make_lods() {
        const std::vector<double> errors =
            options_.lod_errors.empty() ? default_lod_errors() : options_.lod_errors;
        step(prepare_share * 0.7, "simplifying");
        std::vector<Lod> lods;
        result_.simplify_seconds = seconds_of(
            [&] { lods = simplify(centered_.positions, centered_.normals, model_.triangles, errors); });
        std::size_t last = 0; // triangles of the step before
        for (const Lod& lod : lods) {
            // Steps that are all alike, or as large as the model, say nothing new.
            if (lod.triangles.empty() || lod.triangles.size() == last) continue;
            last = lod.triangles.size();
            MethodReport report;
            auto method = on_one_thread(Family::lod, lod.positions, lod.normals, lod.triangles, report);
            method->target_error = lod.target_error;
            add(std::move(method), "lod " + std::to_string(lod.triangles.size()), std::move(report));
        }
    }

    void measure_set(RaySet set, double begin, double length) {
        step(begin, std::string("errors of ") + measure::name(set) + " rays");
        RayBatch batch(set, make_rays(set, options_.rays, seed, centered_.positions, model_.triangles));
        if (batch.rays().empty()) return;
        const std::vector<RayAnswer> truth = truth_->trace(batch.rays());
        std::map<double, std::vector<std::uint8_t>> bands;
        for (std::size_t i = 0; i < methods_.size(); ++i) {
            TraceMethod& method = *methods_[i];
            method.prepare(batch);
            SetErrors errors{set, band_width(method.cells), {}};
            std::vector<std::uint8_t>& band = bands[errors.band_width];
            if (band.empty()) band = truth_->silhouette_band(batch.rays(), truth, float(errors.band_width));
            if (batch.occlusion()) {
                const CallKind kind = best_kind(method);
                method.reset(batch, kind);
                trace_all(method, batch, kind);
                method.store_blocked(batch, kind);
                errors.errors = compare_occlusion(truth, batch.blocked, band);
            } else {
                errors.errors = compare_answers(batch.rays(), truth, answers_of(method, batch), band);
            }
            result_.methods[i].errors.push_back(errors);
        }
        if (set == RaySet::chords && options_.parts) measure_parts(batch, truth);
        time_set(batch, begin + length * 0.3, length * 0.7);
    }

    void time_set(RayBatch& batch, double begin, double length) {
        std::map<std::tuple<std::size_t, unsigned, CallKind>, std::vector<double>> measured;
        for (unsigned run = 0; run < options_.runs; ++run) {
            step(begin + length * run / options_.runs,
                 std::string("times of ") + measure::name(batch.set()) + " rays");
            for (std::size_t i = 0; i < methods_.size(); ++i) {
                for (const CallKind kind : {CallKind::single, CallKind::stream}) {
                    if (kind == CallKind::stream && !methods_[i]->has_stream()) continue;
                    for (std::size_t t = 0; t < options_.threads.size(); ++t) {
                        if (t > 0 && batch.set() != RaySet::chords) continue;
                        const unsigned threads = options_.threads[t];
                        measured[{i, threads, kind}].push_back(
                            nanoseconds(*methods_[i], batch, kind, threads));
                    }
                }
            }
        }
        for (const auto& [key, values] : measured) {
            const auto& [i, threads, kind] = key;
            result_.methods[i].timings.push_back(
                {batch.set(), threads, kind, methods_[i]->call_name(batch.set(), kind), spread_of(values)});
        }
    }

    static double nanoseconds(const TraceMethod& method, RayBatch& batch, CallKind kind, unsigned threads) {
        method.reset(batch, kind);
        double seconds = 0;
        if (threads == 1) {
            seconds = thread_seconds_of([&] { method.trace(batch, kind, 0, batch.rays().size()); });
        } else {
            tbb::task_arena arena{int(threads)};
            arena.execute([&] { seconds = seconds_of([&] { trace_all(method, batch, kind); }); });
        }
        return seconds * 1e9 / double(batch.rays().size());
    }

    // Answers of all chords, by the projective tracer.
    std::vector<RayAnswer> trace_map(const bake::OwnedMap& map, std::uint32_t layers, RayBatch& batch) const {
        const auto method = map_method(Family::projective, map.map.parts.front(), layers, 0);
        return answers_of(*method, batch);
    }

    void measure_parts(RayBatch& batch, const std::vector<RayAnswer>& truth) {
        std::map<std::uint32_t, std::vector<RayAnswer>> ideal; // by layers
        for (std::size_t i = 0; i < methods_.size(); ++i) {
            const TraceMethod& method = *methods_[i];
            if (method.family != Family::projective) continue;
            std::vector<RayAnswer>& far = ideal[method.layers];
            if (far.empty())
                far = trace_map(bake(ideal_cells, method.layers, ElementFormat::f32), method.layers, batch);
            const std::vector<RayAnswer> exact =
                trace_map(bake(method.cells, method.layers, ElementFormat::f32), method.layers, batch);
            const bake::OwnedMap stored = bake(method.cells, method.layers, ElementFormat::u16);
            const std::vector<RayAnswer> traced = answers_of(method, batch);
            const std::vector<RayAnswer> judged = solver_judge(stored, method.layers, batch);
            result_.methods[i].parts = parts_of(batch, truth, far, exact, traced, judged);
        }
    }

    // What rays meet on the stored surface itself; empty where that is no mesh.
    static std::vector<RayAnswer> solver_judge(const bake::OwnedMap& map, std::uint32_t layers,
                                               const RayBatch& batch) {
        bool complete = false;
        if (layers != 1) return {};
        const MapSurface surface = outermost_surface(map.map.parts.front(), complete);
        if (!complete) return {};
        const trace::TriangleScene scene(surface.positions, surface.triangles);
        std::vector<RayAnswer> answers(batch.rays().size());
        tbb::parallel_for(std::size_t(0), answers.size(), [&](std::size_t i) {
            trace::TriangleHit hit;
            const trace::Ray& ray = batch.rays()[i];
            if (scene.closest_hit(ray.origin, ray.direction, ray.t_max, hit)) answers[i].t = hit.t;
        });
        return answers;
    }

    static ErrorParts parts_of(const RayBatch& batch, const std::vector<RayAnswer>& truth,
                               const std::vector<RayAnswer>& far, const std::vector<RayAnswer>& exact,
                               const std::vector<RayAnswer>& traced, const std::vector<RayAnswer>& judged) {
        ErrorParts parts;
        double count = 0, solver = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (!truth[i].hits() || !far[i].hits() || !exact[i].hits() || !traced[i].hits()) continue;
            if (!judged.empty() && !judged[i].hits()) continue;
            const double unit = length(to_double(batch.rays()[i].direction));
            const auto distance = [&](const RayAnswer& a, const RayAnswer& b) {
                return std::abs(double(a.t) - double(b.t)) * unit;
            };
            count += 1;
            parts.star += distance(truth[i], far[i]);
            parts.resolution += distance(far[i], exact[i]);
            parts.quantization += distance(exact[i], traced[i]);
            parts.total += distance(truth[i], traced[i]);
            if (!judged.empty()) solver += distance(judged[i], traced[i]);
        }
        if (count == 0) return parts;
        for (double* const part : {&parts.star, &parts.resolution, &parts.quantization, &parts.total})
            *part /= count;
        if (!judged.empty()) parts.solver = solver / count;
        return parts;
    }

    const Model& model_;
    const TraceBenchOptions& options_;
    bake::CenteredModel centered_;
    std::optional<trace::TriangleScene> scene_;
    std::optional<RayTruth> truth_;
    std::vector<std::unique_ptr<TraceMethod>> methods_;
    TraceBenchmark result_;
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

std::vector<double> default_lod_errors() {
    std::vector<double> errors;
    for (int i = 0; i <= 9; ++i) errors.push_back(0.05 * std::pow(10, -i / 3.0));
    return errors;
}

TraceBenchmark bench_trace(const Model& model, const TraceBenchOptions& options) {
    return Bench(model, options).run();
}

} // namespace spa::measure
