// SPDX-License-Identifier: Apache-2.0
#include "search.h"

#include "file_bytes.h"
#include "place.h"

#include "../bake/arena.h"
#include "../core/error.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

namespace spa::plan {

double footprint_tolerance(double footprint) {
    constexpr double share_of_footprint = 0.1;
    return share_of_footprint * std::tan(footprint * std::numbers::pi / 180);
}

const char* name(Limit limit) {
    switch (limit) {
    case Limit::shape: return "shape";
    case Limit::cells: return "size";
    case Limit::max_bytes: return "max-bytes";
    case Limit::none: break;
    }
    return "none";
}

namespace {

using Clock = std::chrono::steady_clock;

// Frames and centres are compared at this size, or the nearest that may be tried.
constexpr std::uint32_t probe_cells = 64;
// A frame or centre that is not the first must be better by this factor to be taken.
constexpr double clearly_better = 0.95;

// Maps of so many layers, size after size.
struct Column {
    std::uint32_t layers = 0;
    std::vector<double> errors; // of request.cells, as far as tried
    Limit stopped_by = Limit::none;
    bool has_deeper = false; // the column of more layers is there
};

// To be tried. Of equal bytes the one that was put in first comes first.
struct Open {
    std::uint64_t bytes = 0; // estimated
    std::size_t column = 0;
    Candidate candidate;
    bool refines = false; // something between two sizes, or with fewer bits, after a success
};

class Search {
public:
    Search(const Model& model, const SearchRequest& request, const bake::Progress& progress)
        : model_(model), request_(request), progress_(progress), components_(find_components(model)) {}

    SearchResult run() {
        const auto start = Clock::now();
        choose_place();
        place_->choose_colors(result_.colors);
        add_column(request_.layers.front());
        while (!result_.met) {
            find_cheapest();
            if (met_.empty()) break;
            verify();
        }
        if (!result_.met) give_up();
        result_.search_seconds =
            std::chrono::duration<double>(Clock::now() - start).count() - result_.final_seconds;
        return std::move(result_);
    }

private:
    void step() const {
        const double share = 0.7 * (1 - std::pow(0.93, double(result_.tried.size())));
        if (progress_ && !progress_(share)) throw bake::Cancelled{};
    }
    [[nodiscard]] bake::Progress progress_between(double from, double to) const {
        if (!progress_) return {};
        return [this, from, to](double share) { return progress_(from + (to - from) * share); };
    }
    // Casts of the search tell when they are cancelled, and not how far they are.
    [[nodiscard]] bake::Progress alive() const {
        if (!progress_) return {};
        return [this](double) { return progress_(0.7 * (1 - std::pow(0.93, double(result_.tried.size())))); };
    }

    [[nodiscard]] std::unique_ptr<Place> place(bake::Frame frame, bake::Center center) const {
        return std::make_unique<Place>(model_, components_, request_, frame, center, unit_, alive_);
    }

    // The frame and centre from which a map of middling size is nearest to the model.
    void choose_place() {
        double best = 0;
        const auto several = request_.frames.size() * request_.centers.size() > 1;
        for (const bake::Center center : request_.centers) {
            for (const bake::Frame frame : request_.frames) {
                std::unique_ptr<Place> other = place(frame, center);
                if (unit_ == 0) unit_ = other->radius();
                if (!several) {
                    place_ = std::move(other);
                    return;
                }
                const double error = probe(*other);
                if (place_ && !(error < clearly_better * best)) continue;
                best = error;
                place_ = std::move(other);
            }
        }
    }

    double probe(Place& place) {
        const auto cells = std::lower_bound(request_.cells.begin(), request_.cells.end() - 1, probe_cells);
        const auto layers = std::lower_bound(request_.layers.begin(), request_.layers.end() - 1, 2U);
        bool truncated = false;
        result_.tried.push_back(
            place.try_out(place.candidate(*cells, *layers, request_.depths.back()), truncated, true));
        step();
        return result_.tried.back().error.value;
    }

    void add_column(std::uint32_t layers) {
        columns_.push_back({layers, {}, Limit::none, false});
        push_size(columns_.size() - 1, 0);
    }

    void push_size(std::size_t column, std::size_t size) {
        const Candidate candidate =
            place_->candidate(request_.cells[size], columns_[column].layers, request_.depths.back());
        const Tried* const before = latest(column);
        push(column, candidate,
             before != nullptr ? place_->estimate_bytes(*before, candidate)
                               : place_->estimate_bytes(candidate),
             false);
    }

    [[nodiscard]] const Tried* latest(std::size_t column) const {
        const auto found = std::find_if(latest_.rbegin(), latest_.rend(),
                                        [&](const auto& entry) { return entry.first == column; });
        return found == latest_.rend() ? nullptr : &result_.tried[found->second];
    }

    void push(std::size_t column, const Candidate& candidate, std::uint64_t bytes, bool refines) {
        const auto known = [&](const Open& open) { return open.candidate == candidate; };
        if (std::any_of(open_.begin(), open_.end(), known)) return;
        if (std::any_of(latest_.begin(), latest_.end(), [&](const auto& entry) {
                return result_.tried[entry.second].candidate == candidate;
            }))
            return;
        open_.push_back({bytes, column, candidate, refines});
    }

    // Tries what is open from cheap to dear, until nothing that is left is cheaper than what meets the
    // target.
    void find_cheapest() {
        while (!open_.empty()) {
            const auto cheapest = std::min_element(
                open_.begin(), open_.end(), [](const Open& a, const Open& b) { return a.bytes < b.bytes; });
            if (const Tried* const best = cheapest_met(); best != nullptr && cheapest->bytes >= best->bytes)
                return;
            const Open next = *cheapest;
            open_.erase(cheapest);
            try_out(next);
        }
    }

    void try_out(const Open& open) {
        Column& column = columns_[open.column];
        // Estimates of bytes are not off by so much.
        constexpr double surely_too_large = 2;
        if (double(open.bytes) > surely_too_large * double(request_.max_bytes)) {
            if (!open.refines) column.stopped_by = Limit::max_bytes;
            return;
        }
        bool truncated = false;
        const std::size_t index = result_.tried.size();
        result_.tried.push_back(place_->try_out(open.candidate, truncated));
        latest_.emplace_back(open.column, index);
        step();
        const Tried tried = result_.tried[index];
        if (tried.met) {
            met_.push_back(index);
            refine(open.column, tried);
        } else if (!open.refines) {
            go_on(open.column, tried);
        }
        if (!truncated || columns_[open.column].has_deeper) return;
        columns_[open.column].has_deeper = true;
        const auto deeper =
            std::upper_bound(request_.layers.begin(), request_.layers.end(), open.candidate.layers);
        if (deeper != request_.layers.end()) add_column(*deeper);
    }

    // Cheaper ones close to one that meets the target.
    void refine(std::size_t column, const Tried& tried) {
        const auto push_other = [&](const Candidate& other) {
            push(column, other, place_->estimate_bytes(tried, other), true);
        };
        Candidate other = tried.candidate;
        other.depth = request_.depths.front();
        if (other.depth != tried.candidate.depth &&
            (is_share(request_.metric) || depth_quantum_error(other.depth) <= request_.target))
            push_other(other);
        other = tried.candidate;
        const bool listed =
            std::find(request_.cells.begin(), request_.cells.end(), other.cells) != request_.cells.end();
        other.cells = other.cells / 4 * 3;
        if (listed && other.cells > request_.cells.front() && other.cells % 2 == 0) push_other(other);
    }

    // The next size, if there is any that can help.
    void go_on(std::size_t column_index, const Tried& tried) {
        Column& column = columns_[column_index];
        if (tried.bytes > request_.max_bytes) {
            column.stopped_by = Limit::max_bytes;
            return;
        }
        column.errors.push_back(tried.error.value);
        const auto at = std::upper_bound(request_.cells.begin(), request_.cells.end(), tried.candidate.cells);
        if (at == request_.cells.end())
            column.stopped_by = has_levelled_off(column, 1) ? Limit::shape : Limit::cells;
        else if (has_levelled_off(column, std::size_t(request_.cells.end() - at)))
            column.stopped_by = Limit::shape;
        else
            push_size(column_index, std::size_t(at - request_.cells.begin()));
    }

    // Even if each of `sizes` more brought more than the better of the last two did.
    [[nodiscard]] bool has_levelled_off(const Column& column, std::size_t sizes) const {
        const std::vector<double>& e = column.errors;
        constexpr std::size_t least = 4; // sizes below tell little
        if (e.size() < std::min(least, request_.cells.size()) || e.size() < 3) return false;
        const double a = e[e.size() - 3], b = e[e.size() - 2], c = e[e.size() - 1];
        if (!std::isfinite(a)) return false;
        const double factor = 0.9 * std::min(c / b, b / a);
        return c * std::pow(factor, double(sizes)) > request_.target;
    }

    [[nodiscard]] const Tried* cheapest_met() const {
        const Tried* best = nullptr;
        for (const std::size_t i : met_)
            if (best == nullptr || result_.tried[i].bytes < best->bytes) best = &result_.tried[i];
        return best;
    }

    // Bakes and measures in full.
    void finish(const Candidate& candidate) {
        const auto start = Clock::now();
        result_.chosen = candidate;
        const bake::Options options = options_of(candidate, request_.options);
        bake::Result baked = bake::bake_model(model_, options, progress_between(0.7, 0.8));
        result_.baked = {std::move(baked.map), {std::move(baked.report)}};
        SphericalMap& map = result_.baked.map.map;
        measure::MeasureOptions measure = request_.measure;
        measure.color_samples = options.samples;
        measure.layers = options.layers;
        measure.threads = options.threads;
        result_.measurement =
            measure::measure_map(model_, map.parts.front(), measure, progress_between(0.8, 1));
        map.parts.front().errors = measure::error_figures(result_.measurement);
        result_.bytes = file_bytes(map, request_.compress) + request_.other_bytes;
        result_.error = figure_of(request_.metric, result_.measurement) *
                        (is_share(request_.metric) ? 1 : place_->radius() / unit_);
        result_.final_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }

    // The cheapest that meets the target by the search's samples, by all. If it does not, it counts as
    // missed.
    void verify() {
        const auto best = std::min_element(met_.begin(), met_.end(), [&](std::size_t a, std::size_t b) {
            return result_.tried[a].bytes < result_.tried[b].bytes;
        });
        const std::size_t index = *best;
        met_.erase(best);
        finish(result_.tried[index].candidate);
        if (result_.error <= request_.target && result_.bytes <= request_.max_bytes) {
            result_.met = true;
            return;
        }
        ++result_.refused;
        Tried& tried = result_.tried[index];
        tried.met = false;
        const auto column = std::find_if(latest_.begin(), latest_.end(), [&](const auto& entry) {
                                return entry.second == index;
                            })->first;
        tried.error.value = result_.error;
        if (result_.bytes > request_.max_bytes) tried.bytes = result_.bytes;
        const Tried missed = tried;
        if (std::find(request_.cells.begin(), request_.cells.end(), missed.candidate.cells) !=
                request_.cells.end() &&
            missed.candidate.depth == request_.depths.back())
            go_on(column, missed);
    }

    void give_up() {
        const Tried* nearest = nullptr;
        for (const Tried& tried : result_.tried) {
            if (tried.error.samples == 0 || tried.bytes > request_.max_bytes) continue;
            if (nearest == nullptr || tried.error.value < nearest->error.value) nearest = &tried;
        }
        result_.stopped_by = limit();
        result_.chosen.reset();
        if (request_.best && nearest != nullptr) finish(nearest->candidate);
    }

    // Of the column that came nearest; of those that came to nothing the first.
    [[nodiscard]] Limit limit() const {
        Limit limit = Limit::max_bytes;
        double best = std::numeric_limits<double>::infinity();
        for (const Column& column : columns_) {
            for (const double error : column.errors) {
                if (!(error < best)) continue;
                best = error;
                limit = column.stopped_by;
            }
        }
        return limit == Limit::none ? Limit::cells : limit;
    }

    const Model& model_;
    const SearchRequest& request_;
    const bake::Progress& progress_;
    Components components_;
    bake::Progress alive_ = alive();
    double unit_ = 0;
    std::unique_ptr<Place> place_;
    std::vector<Column> columns_;
    std::vector<Open> open_;
    std::vector<std::pair<std::size_t, std::size_t>> latest_; // column and index into tried, as tried
    std::vector<std::size_t> met_;                            // indices into tried
    SearchResult result_;
};

} // namespace

SearchResult search(const Model& model, const SearchRequest& request, const bake::Progress& progress) {
    if (model.triangles.empty())
        throw Error(ExitCode::invalid_data, "the model has no triangles: nothing to bake");
    if (is_of_rays(request.metric) && request.options.grid.mapping != Mapping::octahedral)
        throw Error(ExitCode::usage, std::string("--target-metric ") + name(request.metric) +
                                         ": rays are traced through octahedral maps; with --mapping latlong "
                                         "use p95-surface or hausdorff");
    std::optional<SearchResult> result;
    tbb::task_arena arena(bake::arena_concurrency(request.options.threads));
    arena.execute([&] { result = Search(model, request, progress).run(); });
    return std::move(*result);
}

} // namespace spa::plan
