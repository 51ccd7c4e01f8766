// SPDX-License-Identifier: Apache-2.0
#include "place.h"

#include "color_judge.h"
#include "file_bytes.h"
#include "ray_judge.h"
#include "surface_judge.h"

#include "../measure/source_radius.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace spa::plan {
namespace {

bake::Options placed(bake::Options options, bake::Frame frame, bake::Center center) {
    options.frame = frame;
    options.center = center;
    return options;
}

// What a sample of a surface takes in a file, depth and normal, about; files of tried candidates say better.
constexpr double bytes_a_sample = 4;

} // namespace

Place::Place(const Model& model, const Components& components, const SearchRequest& request,
             bake::Frame frame, bake::Center center, double unit, const bake::Progress& progress)
    : model_(model), request_(request), frame_(frame), center_(center),
      baker_(model, components, placed(request.options, frame, center), progress),
      radius_(is_of_rays(request.metric) ? measure::radius_about(model, baker_.place().center, Mat3{})
                                         : baker_.place().radius),
      color_cells_(request.color_cells.front()) {
    if (is_of_rays(request.metric)) {
        RayJudgeOptions options;
        options.metric = request.metric;
        options.unit = unit;
        judge_ = std::make_unique<RayJudge>(model, baker_.place().center, options);
    } else {
        SurfaceJudgeOptions options;
        options.metric = request.metric;
        options.unit = unit;
        judge_ = std::make_unique<SurfaceJudge>(model, options);
    }
}

void Place::choose_colors(std::vector<TriedColor>& tried) {
    if (request_.color_cells.size() == 1) return;
    color_bytes_.clear();
    const ColorJudge judge(model_, baker_.place(), request_.footprint);
    // Where no size keeps the target, texels that bring less than a twentieth are not worth their bytes.
    constexpr double worth_it = 0.95;
    double best = std::numeric_limits<double>::infinity();
    const std::uint64_t most_bytes = request_.max_bytes / 2; // the other half is for the shape
    for (const std::uint32_t cells : request_.color_cells) {
        Candidate probe = candidate(cells, request_.layers.front(), request_.depths.front());
        probe.color_cells = cells;
        if (!tried.empty() &&
            baker_.estimate_color_bytes(options_of(probe, request_.options), request_.compress) > most_bytes)
            return;
        const double error = judge.error(cells);
        tried.push_back({cells, error});
        if (error < worth_it * best) {
            best = error;
            color_cells_ = cells;
        }
        if (error <= request_.color_target) return;
    }
}

Candidate Place::candidate(std::uint32_t cells, std::uint32_t layers, ElementFormat depth) const {
    return {cells, color_cells_, depth, layers, frame_, center_};
}

std::uint64_t Place::color_bytes(const Candidate& candidate) {
    const auto found = color_bytes_.find(candidate.layers);
    if (found != color_bytes_.end()) return found->second;
    const std::uint64_t bytes =
        baker_.estimate_color_bytes(options_of(candidate, request_.options), request_.compress);
    return color_bytes_.emplace(candidate.layers, bytes).first->second;
}

Tried Place::try_out(const Candidate& candidate, bool& truncated, bool exactly) {
    const auto start = std::chrono::steady_clock::now();
    Tried tried;
    tried.candidate = candidate;
    const Shape shape = baker_.bake(options_of(candidate, request_.options));
    truncated = shape.truncated;
    tried.bytes =
        file_bytes(shape.map.map, request_.compress) + color_bytes(candidate) + request_.other_bytes;
    if (tried.bytes <= request_.max_bytes) {
        tried.error =
            judge_->judge(shape.map.map.parts.front(), exactly ? Judge::never_clear : request_.target);
        tried.met = tried.error.high <= request_.target;
    }
    tried.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return tried;
}

std::uint64_t Place::estimate_bytes(const Tried& tried, const Candidate& other) {
    const std::uint64_t fixed = color_bytes(tried.candidate) + request_.other_bytes;
    // Per sample files shrink a little as they grow: neighbours are more alike.
    double ratio = double(other.cells) / tried.candidate.cells;
    ratio = std::pow(ratio, 1.9);
    if (other.depth != tried.candidate.depth) ratio *= 0.8;
    return fixed + std::uint64_t(double(tried.bytes - fixed) * ratio);
}

std::uint64_t Place::estimate_bytes(const Candidate& candidate) {
    const Grid grid = grid_of(request_.options.grid.mapping, candidate.cells);
    return color_bytes(candidate) + request_.other_bytes +
           std::uint64_t(bytes_a_sample * grid.width * grid.height * candidate.layers);
}

} // namespace spa::plan
