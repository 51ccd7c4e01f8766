// SPDX-License-Identifier: Apache-2.0
#include "search_parts.h"

#include "file_bytes.h"

#include "../measure/measure_parts.h"

#include <algorithm>
#include <chrono>

namespace spa::plan {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t trial_rays = 30'000;
constexpr std::uint32_t trial_star_cells = 16; // what the star error is does not matter here

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class PartsSearch {
public:
    PartsSearch(const Model& model, const Partition& partition, const SearchRequest& request,
                const bake::Progress& progress)
        : model_(model), partition_(partition), request_(request), progress_(progress) {}

    SearchResult run() {
        const auto start = Clock::now();
        std::optional<Candidate> nearest;
        double least = 0;
        for (std::size_t i = 0; i < request_.cells.size() && !result_.met; ++i) {
            const Candidate candidate = candidate_of(request_.cells[i]);
            step(double(i));
            if (!try_out(candidate)) break;
            const Tried& tried = result_.tried.back();
            if (!nearest || tried.error.value < least) {
                nearest = candidate;
                least = tried.error.value;
            }
            if (tried.met) verify(candidate);
        }
        if (!result_.met) {
            if (result_.stopped_by == Limit::none) result_.stopped_by = Limit::cells;
            result_.chosen.reset();
            if (request_.best && nearest) finish(*nearest);
        }
        result_.search_seconds = seconds_since(start) - result_.final_seconds;
        return std::move(result_);
    }

private:
    void step(double done) const {
        if (progress_ && !progress_(done / double(request_.cells.size() + 1))) throw bake::Cancelled{};
    }

    [[nodiscard]] Candidate candidate_of(std::uint32_t cells) const {
        Candidate candidate;
        candidate.cells = cells;
        // Colours of a part cover less of the object than those of the whole.
        candidate.color_cells = std::clamp(cells, request_.color_cells.front(), request_.color_cells.back());
        candidate.depth = request_.depths.back();
        const auto two = std::lower_bound(request_.layers.begin(), request_.layers.end() - 1, 2U);
        candidate.layers = *two;
        candidate.frame = request_.options.frame;
        candidate.center = request_.options.center;
        return candidate;
    }

    // False if it is too large, and the next would be larger.
    bool try_out(const Candidate& candidate) {
        const auto start = Clock::now();
        const bake::Options options = options_of(candidate, request_.options);
        const bake::PartsResult baked = bake::bake_parts(model_, partition_, options);
        Tried tried;
        tried.candidate = candidate;
        tried.bytes = file_bytes(baked.map.map, request_.compress) + request_.other_bytes;
        const bool fits = tried.bytes <= request_.max_bytes;
        if (fits) {
            measure::Measurement figures;
            measure::MeasureOptions measure = measure_options(options);
            if (is_of_rays(request_.metric))
                figures.rays = measure::measure_rays(model_, partition_, baked.map.map.parts,
                                                     {.rays = std::min(trial_rays, measure.rays),
                                                      .layers = options.layers,
                                                      .star_cells = trial_star_cells,
                                                      .threads = options.threads});
            else {
                measure.rays = 0;
                figures = measure::measure_parts(model_, partition_, baked.map.map.parts, measure).whole;
            }
            const double error = figure_of(request_.metric, figures);
            tried.error = {error, error, error,
                           figures.rays ? figures.rays->errors.rays() : figures.surface.size()};
            tried.met = error <= request_.target;
        } else {
            result_.stopped_by = Limit::max_bytes;
        }
        tried.seconds = seconds_since(start);
        result_.tried.push_back(tried);
        return fits;
    }

    [[nodiscard]] measure::MeasureOptions measure_options(const bake::Options& options) const {
        measure::MeasureOptions measure = request_.measure;
        measure.color_samples = options.samples;
        measure.layers = options.layers;
        measure.threads = options.threads;
        return measure;
    }

    void finish(const Candidate& candidate) {
        const auto start = Clock::now();
        result_.chosen = candidate;
        const bake::Options options = options_of(candidate, request_.options);
        result_.baked = bake::bake_parts(model_, partition_, options);
        std::vector<Part>& parts = result_.baked.map.map.parts;
        measure::PartsMeasurement measured =
            measure::measure_parts(model_, partition_, parts, measure_options(options));
        for (std::size_t i = 0; i < parts.size(); ++i)
            parts[i].errors = measure::error_figures(measured.parts[i]);
        result_.measurement = std::move(measured.whole);
        result_.bytes = file_bytes(result_.baked.map.map, request_.compress) + request_.other_bytes;
        result_.error = figure_of(request_.metric, result_.measurement);
        result_.final_seconds += seconds_since(start);
    }

    void verify(const Candidate& candidate) {
        finish(candidate);
        result_.met = result_.error <= request_.target && result_.bytes <= request_.max_bytes;
        if (result_.met) return;
        ++result_.refused;
        result_.tried.back().met = false;
        result_.tried.back().error.value = result_.error;
    }

    const Model& model_;
    const Partition& partition_;
    const SearchRequest& request_;
    const bake::Progress& progress_;
    SearchResult result_;
};

} // namespace

SearchResult search_parts(const Model& model, const Partition& partition, const SearchRequest& request,
                          const bake::Progress& progress) {
    return PartsSearch(model, partition, request, progress).run();
}

} // namespace spa::plan
