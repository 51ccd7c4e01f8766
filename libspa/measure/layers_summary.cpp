// SPDX-License-Identifier: Apache-2.0
#include "layers_summary.h"

#include <algorithm>
#include <functional>
#include <set>

namespace spa::measure {
namespace {

constexpr std::uint32_t judged_layers = 2;

using Value = std::function<double(const LayerFigures&)>;

struct SizeLimit {
    std::uint32_t cells;
    double false_hits, missed_hits, distance;
};
constexpr SizeLimit size_limits[] = {{128, 0.15e-2, 0.25e-2, 2.5e-3}, {256, 0.06e-2, 0.12e-2, 1.1e-3}};
constexpr double interior_limit = 0.005e-2, time_limit = 1.15, fold_share_limit = 0.15;
constexpr double open_limit = 3;

bool is_judged(const LayerFigures& row) {
    return row.reconstruction == Reconstruction::folds && row.layers == judged_layers;
}

// Of a size for which there are limits.
bool has_limits(const LayerFigures& row) {
    return std::any_of(std::begin(size_limits), std::end(size_limits),
                       [&](const SizeLimit& limit) { return limit.cells == row.cells; });
}

class Judge {
public:
    explicit Judge(std::span<const LayersMesh> meshes) : meshes_(meshes), mean_(closed_mean(meshes)) {}

    std::vector<LayersBar> judge() {
        for (const SizeLimit& limit : size_limits) {
            at_size("false hits", limit.cells, limit.false_hits, "share",
                    [](const auto& row) { return row.false_hits; });
            at_size("missed hits", limit.cells, limit.missed_hits, "share",
                    [](const auto& row) { return row.missed_hits; });
            at_size("mean |dt|", limit.cells, limit.distance, "R",
                    [](const auto& row) { return row.distance_mean; });
        }
        at_worst("interior false hits", interior_limit, "share",
                 [](const auto& row) { return row.interior_false; });
        at_worst("interior missed hits", interior_limit, "share",
                 [](const auto& row) { return row.interior_missed; });
        const bool timed = std::any_of(mean_.begin(), mean_.end(), [](const auto& row) {
            return is_judged(row) && row.time_ratio.has_value();
        });
        if (timed)
            at_worst("time against one interval", time_limit, "times",
                     [](const auto& row) { return row.time_ratio.value_or(0); });
        at_worst("fold records in the file", fold_share_limit, "share",
                 [](const auto& row) { return row.fold_share; });
        for (const LayersMesh& mesh : meshes_)
            if (!mesh.benchmark.closed()) open(mesh);
        return std::move(bars_);
    }

private:
    void at_size(const char* name, std::uint32_t cells, double limit, const char* unit, const Value& value) {
        for (const LayerFigures& row : mean_)
            if (is_judged(row) && row.cells == cells) add(name, false, row, limit, unit, value);
    }

    void at_worst(const char* name, double limit, const char* unit, const Value& value) {
        const bool any_size = std::none_of(mean_.begin(), mean_.end(), has_limits);
        const LayerFigures* worst = nullptr;
        for (const LayerFigures& row : mean_)
            if (is_judged(row) && (any_size || has_limits(row)) &&
                (worst == nullptr || value(row) > value(*worst)))
                worst = &row;
        if (worst != nullptr) add(name, true, *worst, limit, unit, value);
    }

    void add(const char* name, bool worst_size, const LayerFigures& row, double limit, const char* unit,
             const Value& value) {
        LayersBar bar;
        bar.name = name;
        bar.cells = row.cells;
        bar.worst_size = worst_size;
        bar.value = value(row);
        bar.limit = limit;
        bar.unit = unit;
        for (const LayersMesh& mesh : meshes_) {
            if (!mesh.benchmark.closed()) continue;
            const LayerRow* const own = mesh.benchmark.find(row.reconstruction, row.layers, row.cells);
            if (own == nullptr) continue;
            const double of_mesh = value(figures_of(*own));
            if (!bar.worst_mesh.empty() && of_mesh <= bar.worst) continue;
            bar.worst = of_mesh;
            bar.worst_mesh = mesh.name;
        }
        bars_.push_back(std::move(bar));
    }

    void open(const LayersMesh& mesh) {
        std::set<std::uint32_t> cells, layers;
        for (const LayerRow& row : mesh.benchmark.rows) {
            cells.insert(row.cells);
            if (row.reconstruction == Reconstruction::folds) layers.insert(row.layers);
        }
        if (cells.empty() || layers.empty()) return;
        const std::uint32_t n = usual_cells(std::vector(cells.begin(), cells.end()));
        const std::uint32_t k = usual_layers(std::vector(layers.begin(), layers.end()));
        const LayerRow* const one = mesh.benchmark.find(Reconstruction::one_depth, 1, n);
        const LayerRow* const folds = mesh.benchmark.find(Reconstruction::folds, k, n);
        if (one == nullptr || folds == nullptr || folds->errors.rays() == 0) return;
        LayersBar bar;
        bar.name = "false hits, one depth against folds";
        bar.cells = n;
        bar.mesh = mesh.name;
        // Where there are none at all: at least.
        const double least = 1 / double(folds->errors.rays());
        bar.value = figures_of(*one).false_hits / std::max(figures_of(*folds).false_hits, least);
        bar.limit = open_limit;
        bar.at_least = true;
        bar.unit = "times";
        bars_.push_back(std::move(bar));
    }

    std::span<const LayersMesh> meshes_;
    std::vector<LayerFigures> mean_;
    std::vector<LayersBar> bars_;
};

constexpr double LayerFigures::*averaged[] = {
    &LayerFigures::false_hits,      &LayerFigures::missed_hits,      &LayerFigures::interior_false,
    &LayerFigures::interior_missed, &LayerFigures::distance_mean,    &LayerFigures::distance_p95,
    &LayerFigures::distance_p99,    &LayerFigures::normal_mean,      &LayerFigures::ns,
    &LayerFigures::file_bytes,      &LayerFigures::fold_bytes,       &LayerFigures::fold_share,
    &LayerFigures::mixed_triangles, &LayerFigures::tangent_triangles};

} // namespace

LayerFigures figures_of(const LayerRow& row) {
    LayerFigures figures;
    figures.reconstruction = row.reconstruction;
    figures.layers = row.layers;
    figures.cells = row.cells;
    const RayErrors& errors = row.errors;
    const auto share = [&](std::uint64_t count) {
        return errors.rays() == 0 ? 0 : double(count) / double(errors.rays());
    };
    figures.false_hits = share(errors.band.extra + errors.interior.extra);
    figures.missed_hits = share(errors.band.missed + errors.interior.missed);
    figures.interior_false = share(errors.interior.extra);
    figures.interior_missed = share(errors.interior.missed);
    figures.distance_mean = errors.distance.mean;
    figures.distance_p95 = errors.distance.p95;
    figures.distance_p99 = errors.distance.p99;
    figures.normal_mean = errors.normal.mean;
    figures.ns = row.ns.median;
    figures.time_ratio = row.time_ratio;
    figures.file_bytes = double(row.file_bytes);
    figures.fold_bytes = double(row.fold_bytes);
    figures.fold_share = row.file_bytes == 0 ? 0 : double(row.fold_bytes) / double(row.file_bytes);
    figures.mixed_triangles = row.mixed_triangles;
    figures.tangent_triangles = row.tangent_triangles;
    return figures;
}

std::size_t closed_count(std::span<const LayersMesh> meshes) {
    return std::size_t(std::count_if(meshes.begin(), meshes.end(),
                                     [](const LayersMesh& mesh) { return mesh.benchmark.closed(); }));
}

std::vector<LayerFigures> closed_mean(std::span<const LayersMesh> meshes) {
    const double count = double(closed_count(meshes));
    std::vector<LayerFigures> mean;
    for (const LayersMesh& mesh : meshes) {
        if (!mesh.benchmark.closed()) continue;
        for (std::size_t i = 0; i < mesh.benchmark.rows.size(); ++i) {
            const LayerFigures row = figures_of(mesh.benchmark.rows[i]);
            if (i == mean.size()) {
                LayerFigures& first = mean.emplace_back();
                first.reconstruction = row.reconstruction;
                first.layers = row.layers;
                first.cells = row.cells;
                if (row.time_ratio) first.time_ratio = 0;
            }
            for (double LayerFigures::*const member : averaged) mean[i].*member += row.*member / count;
            if (mean[i].time_ratio) *mean[i].time_ratio += row.time_ratio.value_or(0) / count;
        }
    }
    return mean;
}

std::vector<LayersBar> layers_bars(std::span<const LayersMesh> meshes) { return Judge(meshes).judge(); }

} // namespace spa::measure
