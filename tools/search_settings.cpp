// SPDX-License-Identifier: Apache-2.0
#include "search_settings.h"

#include "memory_budget.h"

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <limits>

namespace spa::tools {

namespace {

using plan::Metric;

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
constexpr double largest_footprint = 45; // degrees

// What a file holds beside the map, about: metadata and tables.
constexpr std::uint64_t bytes_of_metadata = 1536;

void refuse_without_target(const GivenSearch& given) {
    const char* const option = given.target_metric ? "--target-metric"
                               : given.max_bytes   ? "--max-bytes"
                               : given.best        ? "--best"
                                                   : nullptr;
    if (option != nullptr)
        throw Error(ExitCode::usage,
                    std::string(option) + " is of a search: give --target-error or --footprint too");
}

double target_of(const GivenSearch& given, Metric metric) {
    if (given.target_error) return *given.target_error;
    if (plan::is_share(metric))
        throw Error(ExitCode::usage, std::string("--footprint says nothing about ") + plan::name(metric) +
                                         ": give --target-error");
    return plan::footprint_tolerance(*given.footprint);
}

} // namespace

void define_search_options(CLI::App& app, GivenSearch& given) {
    const plan::SearchRequest defaults;
    add_text(app, "--target-error", "E",
             "Look for the cheapest map whose error is at most this, in the unit of --target-metric: tries "
             "sizes, layers, bits, frames and centres that are not given themselves, from cheap to dear. "
             "Measures what it writes, as --measure does. Exit code 6 and no file if no map is that exact",
             [&given](const std::string& text) {
                 given.target_error = parse_measure("--target-error", text);
                 if (!(*given.target_error > 0))
                     throw Error(ExitCode::usage, "--target-error: '" + text +
                                                      "' is no error that a map can keep; give a number "
                                                      "above 0, such as 0.01");
             });
    add_choice<Metric>(app, "--target-metric",
                       {Metric::p95_dt, Metric::p99_dt, Metric::mean_dt, Metric::false_hits,
                        Metric::missed_hits, Metric::p95_surface, Metric::hausdorff},
                       "What --target-error is about: -dt are errors along rays that hit map and asset, in "
                       "radii; -hits are shares of all rays; p95-surface and hausdorff are distances between "
                       "the surfaces, both ways, in radii",
                       [&given](Metric metric) { given.target_metric = metric; })
        ->default_str(name(defaults.metric));
    add_text(app, "--max-bytes", "N", "The largest file that a search may choose, such as 64K or 2M",
             [&given](const std::string& text) { given.max_bytes = parse_byte_count("--max-bytes", text); });
    add_text(app, "--footprint", "DEG",
             "What a ray sees at once, as the half-angle of a cone seen from the object's centre, up to 45. "
             "Colours finer than that are averaged before they are compared. Without --target-error a tenth "
             "of its radius is the target",
             [&given](const std::string& text) {
                 given.footprint = parse_measure("--footprint", text);
                 if (!(*given.footprint > 0 && *given.footprint <= largest_footprint))
                     throw Error(ExitCode::usage,
                                 "--footprint: '" + text + "' is not above 0 and at most 45 degrees");
             });
    app.add_flag("--best", given.best,
                 "Write the map that comes nearest to the target where none meets it; the exit code is 6 "
                 "all the same");
}

std::optional<plan::SearchRequest> complete_search(const GivenSearch& given, const GivenByHand& by_hand,
                                                   const bake::Options& options) {
    if (!given.target_error && !given.footprint) {
        refuse_without_target(given);
        return {};
    }
    plan::SearchRequest request;
    request.options = options;
    request.metric = given.target_metric.value_or(
        options.grid.mapping == Mapping::octahedral ? request.metric : Metric::p95_surface);
    request.target = target_of(given, request.metric);
    request.footprint = given.footprint.value_or(0);
    request.max_bytes = given.max_bytes.value_or(no_limit);
    request.other_bytes = bytes_of_metadata;
    request.best = given.best;
    if (plan::is_of_rays(request.metric) && options.grid.mapping != Mapping::octahedral)
        throw Error(ExitCode::usage, std::string("--target-metric ") + plan::name(request.metric) +
                                         " is of rays, which latlong maps are not traced by; with --mapping "
                                         "latlong use p95-surface or hausdorff");
    for (const auto& [is_given, grid] :
         {std::pair(by_hand.size, options.grid), std::pair(by_hand.color_size, options.color_grid)}) {
        if (is_given && plan::grid_of(grid.mapping, plan::cells_of(grid)) != grid)
            throw Error(ExitCode::usage,
                        "a search takes latlong maps of N by N/2 texels: give a number alone");
    }
    if (by_hand.size) request.cells = {plan::cells_of(options.grid)};
    if (by_hand.color_size) request.color_cells = {plan::cells_of(options.color_grid)};
    if (by_hand.depth) request.depths = {options.depth};
    if (by_hand.layers) request.layers = {options.layers};
    if (by_hand.frame) request.frames = {options.frame};
    if (by_hand.center) request.centers = {options.center};
    return request;
}

void add_search_options(const plan::SearchRequest& request, nlohmann::ordered_json& options) {
    const auto drop = [&](const char* option, std::size_t choices) {
        if (choices > 1) options.erase(option);
    };
    drop("size", request.cells.size());
    drop("color_size", request.color_cells.size());
    drop("depth", request.depths.size());
    drop("layers", request.layers.size());
    drop("frame", request.frames.size());
    drop("center", request.centers.size());
    options["target_error"] = request.target;
    options["target_metric"] = plan::name(request.metric);
    if (request.max_bytes != no_limit) options["max_bytes"] = request.max_bytes;
    if (request.footprint > 0) options["footprint"] = request.footprint;
    options["best"] = request.best;
}

} // namespace spa::tools
