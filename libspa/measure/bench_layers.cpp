// SPDX-License-Identifier: Apache-2.0
#include "bench_layers.h"

#include "ray_truth.h"
#include "trace_methods.h"

#include "../bake/arena.h"
#include "../bake/center.h"
#include "../core/folds.h"
#include "../trace/triangle_scene.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace spa::measure {
namespace {

constexpr std::uint32_t judged_cells = 128, judged_layers = 2;

double texel(std::uint32_t cells) { return 2.0 / cells; }

// A map that is traced, and its row in the report.
struct Subject {
    LayerRow row;
    std::unique_ptr<TraceMethod> method;
    std::vector<double> ns; // run by run
};

class Bench {
public:
    Bench(const Model& model, const LayersOptions& options)
        : model_(model), options_(options),
          batch_(RaySet::chords, make_rays(RaySet::chords, options.rays, options.seed, {}, {})) {}

    LayersBenchmark run() {
        result_.vertices = model_.positions.size();
        result_.triangles = model_.triangles.size();
        for (const std::uint32_t cells : options_.cells) measure_size(cells);
        return std::move(result_);
    }

private:
    // How long the maps of one size take to bake, and everything else, about.
    static double weight(std::uint32_t cells) { return 1e5 + double(cells) * cells; }

    void step(double share, const std::string& what) const {
        double before = 0, all = 0, here = 0;
        for (const std::uint32_t cells : options_.cells) {
            all += weight(cells);
            if (cells < size_) before += weight(cells);
            if (cells == size_) here = weight(cells);
        }
        if (options_.progress && !options_.progress((before + share * here) / all, what))
            throw bake::Cancelled{};
    }

    void measure_size(std::uint32_t cells) {
        size_ = cells;
        std::vector<std::pair<Reconstruction, std::uint32_t>> kinds{{Reconstruction::one_depth, 1}};
        for (const Reconstruction kind : {Reconstruction::tangents, Reconstruction::folds})
            for (const std::uint32_t layers : options_.layers) kinds.emplace_back(kind, layers);
        std::vector<Subject> subjects;
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            step(0.5 * double(i) / double(kinds.size()), "baking " + std::to_string(cells));
            subjects.push_back(make(kinds[i].first, kinds[i].second));
        }
        count_fold_bytes(subjects);
        step(0.5, "errors");
        measure_errors(subjects);
        if (options_.view_side > 0 && cells == usual_cells(options_.cells)) take_view(subjects);
        for (unsigned run = 0; run < options_.runs; ++run) {
            step(0.6 + 0.4 * run / options_.runs, "times");
            for (Subject& subject : subjects)
                subject.ns.push_back(one_thread_ns(*subject.method, batch_, CallKind::stream));
        }
        for (Subject& subject : subjects) {
            subject.row.ns = spread_of(subject.ns);
            subject.row.time_ratio = time_ratio(subject, subjects);
            result_.rows.push_back(std::move(subject.row));
        }
    }

    Subject make(Reconstruction kind, std::uint32_t layers) {
        bake::Options bake = reconstruction_options(kind, layers, size_);
        bake.center = options_.center;
        bake.threads = options_.threads;
        bake::Result baked = bake::bake_model(model_, bake);
        const Part& part = baked.map.map.parts.front();
        Subject subject;
        LayerRow& row = subject.row;
        row.reconstruction = kind;
        row.layers = layers;
        row.cells = size_;
        row.fold_records = part.folds.size() / fold_record_bytes;
        row.mixed_triangles = baked.report.mixed_triangles.value_or(0);
        row.tangent_triangles = trace::TraceMap(part, {0, false}).tangent_share();
        if (options_.file_bytes) row.file_bytes = options_.file_bytes(baked.map.map);
        subject.method = map_method(Family::projective, part, layers, 0);
        if (!truth_) look_at_model(part, baked.report);
        row.bake = std::move(baked.report);
        return subject;
    }

    // All maps have the centre and the sphere of the first.
    void look_at_model(const Part& part, const bake::Report& report) {
        result_.components = report.components;
        result_.open_edges = report.open_edges;
        result_.center = part.center;
        result_.radius = part.radius;
        centered_ = bake::center_model(model_, {part.center, part.frame, part.radius});
        scene_.emplace(centered_.positions, model_.triangles);
        truth_.emplace(centered_, *scene_);
        answers_ = truth_->trace(batch_.rays());
    }

    // A file with folds and the same without them.
    static void count_fold_bytes(std::vector<Subject>& subjects) {
        for (Subject& folds : subjects) {
            if (folds.row.reconstruction != Reconstruction::folds) continue;
            for (const Subject& other : subjects)
                if (other.row.reconstruction == Reconstruction::tangents &&
                    other.row.layers == folds.row.layers && other.row.file_bytes < folds.row.file_bytes)
                    folds.row.fold_bytes = folds.row.file_bytes - other.row.file_bytes;
        }
    }

    void measure_errors(std::vector<Subject>& subjects) {
        const double width = 2 * texel(size_);
        const auto band = near_silhouette(*truth_, batch_.rays(), answers_, float(width));
        for (Subject& subject : subjects) {
            subject.row.band_width = width;
            subject.row.errors =
                compare_answers(batch_.rays(), answers_, answers_of(*subject.method, batch_), band);
        }
    }

    void take_view(const std::vector<Subject>& subjects) {
        LayerView& view = result_.view;
        view.side = options_.view_side;
        view.cells = size_;
        view.layers = usual_layers(options_.layers);
        view.rays = make_rays(RaySet::primary, view.side * view.side, options_.seed, {}, {});
        view.source = truth_->trace(view.rays);
        RayBatch batch(RaySet::primary, view.rays);
        for (const Subject& subject : subjects) {
            if (subject.row.reconstruction == Reconstruction::one_depth)
                view.one_depth = answers_of(*subject.method, batch);
            if (subject.row.reconstruction == Reconstruction::folds && subject.row.layers == view.layers)
                view.folds = answers_of(*subject.method, batch);
        }
    }

    static std::optional<double> time_ratio(const Subject& subject, const std::vector<Subject>& subjects) {
        if (subject.row.reconstruction == Reconstruction::one_depth) return {};
        for (const Subject& one : subjects) {
            if (one.row.reconstruction != subject.row.reconstruction || one.row.layers != 1) continue;
            std::vector<double> ratios;
            for (std::size_t run = 0; run < one.ns.size(); ++run)
                ratios.push_back(subject.ns[run] / one.ns[run]);
            return spread_of(std::move(ratios)).median;
        }
        return {};
    }

    const Model& model_;
    const LayersOptions& options_;
    RayBatch batch_;
    std::uint32_t size_ = 0; // whose maps are being measured
    LayersBenchmark result_;
    bake::CenteredModel centered_;
    std::optional<trace::TriangleScene> scene_;
    std::optional<RayTruth> truth_;
    std::vector<RayAnswer> answers_; // of the batch, by the model
};

} // namespace

const char* name(Reconstruction reconstruction) {
    switch (reconstruction) {
    case Reconstruction::one_depth: return "one_depth";
    case Reconstruction::tangents: return "tangents";
    case Reconstruction::folds: break;
    }
    return "folds";
}

const char* title(Reconstruction reconstruction) {
    switch (reconstruction) {
    case Reconstruction::one_depth: return "one depth";
    case Reconstruction::tangents: return "tangents";
    case Reconstruction::folds: break;
    }
    return "folds";
}

bake::Options reconstruction_options(Reconstruction reconstruction, std::uint32_t layers,
                                     std::uint32_t cells) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
    const bool intervals = reconstruction != Reconstruction::one_depth;
    options.layers = intervals ? layers : 1;
    options.inner_of_one = intervals && layers == 1;
    options.folds = reconstruction == Reconstruction::folds;
    return options;
}

std::uint32_t usual_cells(std::span<const std::uint32_t> cells) {
    std::uint32_t usual = *std::max_element(cells.begin(), cells.end());
    for (const std::uint32_t n : cells)
        if (n >= judged_cells) usual = std::min(usual, n);
    return usual;
}

std::uint32_t usual_layers(std::span<const std::uint32_t> layers) {
    const bool there = std::find(layers.begin(), layers.end(), judged_layers) != layers.end();
    return there ? judged_layers : *std::max_element(layers.begin(), layers.end());
}

const LayerRow* LayersBenchmark::find(Reconstruction reconstruction, std::uint32_t layers,
                                      std::uint32_t cells) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const LayerRow& row) {
        return row.reconstruction == reconstruction && row.layers == layers && row.cells == cells;
    });
    return found == rows.end() ? nullptr : &*found;
}

std::vector<std::uint8_t> near_silhouette(const RayTruth& judge, std::span<const trace::Ray> rays,
                                          std::span<const RayAnswer> truth, float width) {
    std::vector<std::uint8_t> near = judge.silhouette_band(rays, truth, width / 2);
    const std::vector<std::uint8_t> far = judge.silhouette_band(rays, truth, width);
    for (std::size_t i = 0; i < near.size(); ++i)
        if (far[i] != 0) near[i] = 1;
    return near;
}

LayersBenchmark bench_layers(const Model& model, const LayersOptions& options) {
    LayersBenchmark result;
    tbb::task_arena arena(bake::arena_concurrency(options.threads));
    arena.execute([&] { result = Bench(model, options).run(); });
    return result;
}

} // namespace spa::measure
