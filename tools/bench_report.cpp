// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include "bake_arguments.h"
#include "text.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace spa::tools {

namespace {

using measure::BakeTiming;
using measure::Caster;
using measure::CastTiming;
using measure::Spread;

nlohmann::ordered_json to_json(const Spread& spread) {
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"runs", spread.runs}};
}

const CastTiming* find(const BenchGrid& grid, Caster caster, unsigned threads) {
    const auto& casts = grid.benchmark.casts;
    const auto found = std::find_if(casts.begin(), casts.end(), [&](const CastTiming& timing) {
        return timing.caster == caster && timing.threads == threads;
    });
    return found == casts.end() ? nullptr : &*found;
}

const BakeTiming* find_bake(const BenchGrid& grid, std::uint32_t layers, unsigned threads) {
    const auto& bakes = grid.benchmark.bakes;
    const auto found = std::find_if(bakes.begin(), bakes.end(), [&](const BakeTiming& timing) {
        return timing.layers == layers && timing.threads == threads;
    });
    return found == bakes.end() ? nullptr : &*found;
}

std::uint64_t sample_count(const Grid& grid) { return std::uint64_t(grid.width) * grid.height; }

// How many times as long as the second the first takes.
std::optional<double> ratio(const std::optional<Spread>& slow, const std::optional<Spread>& fast) {
    if (!slow || !fast || !(fast->median > 0)) return {};
    return slow->median / fast->median;
}

// Of one grid and number of threads; what was not timed is absent.
struct Row {
    unsigned threads = 1;
    std::optional<Spread> radial_hits, embree_hits, embree_build, radial, embree, orbit, naive;
    std::uint64_t views_timed = 0;
    std::optional<Spread> bake_1, bake_2;
};

std::vector<Row> rows_of(const BenchGrid& grid) {
    std::vector<Row> rows;
    for (const CastTiming& timing : grid.benchmark.casts) {
        const unsigned threads = timing.threads;
        if (std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.threads == threads; }))
            continue;
        Row row;
        row.threads = threads;
        if (const CastTiming* t = find(grid, Caster::radial, threads)) {
            row.radial = t->crossings;
            row.radial_hits = t->hits;
        }
        if (const CastTiming* t = find(grid, Caster::embree, threads)) {
            row.embree = t->crossings;
            row.embree_hits = t->hits;
            row.embree_build = t->build;
        }
        if (const CastTiming* t = find(grid, Caster::orbit, threads)) row.orbit = t->crossings;
        if (const CastTiming* t = find(grid, Caster::naive, threads)) {
            row.naive = t->crossings;
            row.views_timed = t->views_timed;
        }
        if (const BakeTiming* t = find_bake(grid, 1, threads)) row.bake_1 = t->seconds;
        if (const BakeTiming* t = find_bake(grid, 2, threads)) row.bake_2 = t->seconds;
        rows.push_back(row);
    }
    return rows;
}

template <class T>
void add(nlohmann::ordered_json& json, const char* key, const std::optional<T>& value) {
    if (!value) return;
    if constexpr (std::is_same_v<T, Spread>)
        json[key] = to_json(*value);
    else
        json[key] = *value;
}

double nanoseconds(const Spread& spread, const BenchLevel& level, const BenchGrid& grid) {
    return spread.median * 1e9 / double(level.triangles + sample_count(grid.benchmark.grid));
}

nlohmann::ordered_json row_json(const Row& row, const BenchLevel& level, const BenchGrid& grid) {
    nlohmann::ordered_json json = {{"threads", row.threads}};
    nlohmann::ordered_json hits = nlohmann::ordered_json::object();
    add(hits, "radial", row.radial_hits);
    add(hits, "embree", row.embree_hits);
    nlohmann::ordered_json crossings = nlohmann::ordered_json::object();
    add(crossings, "radial", row.radial);
    add(crossings, "embree", row.embree);
    add(crossings, "orbit", row.orbit);
    add(crossings, "naive", row.naive);
    json["hits"] = std::move(hits);
    json["crossings"] = std::move(crossings);
    add(json, "embree_build", row.embree_build);
    if (row.naive) json["naive_views_timed"] = row.views_timed;
    add(json, "bake_1_layer", row.bake_1);
    add(json, "bake_2_layers", row.bake_2);
    nlohmann::ordered_json ratios = nlohmann::ordered_json::object();
    add(ratios, "embree_radial_hits", ratio(row.embree_hits, row.radial_hits));
    add(ratios, "embree_radial_crossings", ratio(row.embree, row.radial));
    add(ratios, "naive_orbit", ratio(row.naive, row.orbit));
    json["ratios"] = std::move(ratios);
    if (row.radial_hits)
        json["radial_hits_ns_per_triangle_and_sample"] = nanoseconds(*row.radial_hits, level, grid);
    return json;
}

// Milliseconds with three digits, and half the range of all runs as a share of the median.
std::string time_text(const std::optional<Spread>& spread) {
    if (!spread) return "-";
    const double ms = spread->median * 1e3;
    const double half_range = (spread->max - spread->min) / 2 / spread->median;
    return fixed(ms, ms < 9.995   ? 2
                     : ms < 99.95 ? 1
                                  : 0) +
           " ±" + pad_left(fixed(half_range * 100, 0), 2) + "%";
}

std::string ratio_text(const std::optional<double>& value) {
    return value ? fixed(*value, *value < 9.95 ? 1 : 0) : "-";
}

// pad_left, for text in which "±" is one column and two bytes.
std::string column(const std::string& text, std::size_t width) {
    return pad_left(text, width + (text.find("±") == std::string::npos ? 0 : 1));
}

std::string heading(const BenchLevel& level, const BenchGrid& grid, const Row& row) {
    return column(std::to_string(level.level), 5) + column(std::to_string(level.triangles), 10) +
           column(size_text(grid.benchmark.grid), 9) + column(std::to_string(row.threads), 4);
}
constexpr const char* heading_titles = "level triangles      map thr";

template <class Line>
std::string table(const BenchReport& report, Line&& line) {
    std::string text;
    for (const BenchLevel& level : report.levels) {
        for (const BenchGrid& grid : level.grids) {
            for (const Row& row : rows_of(grid))
                text += heading(level, grid, row) + line(level, grid, row) + "\n";
        }
    }
    return text;
}

} // namespace

nlohmann::ordered_json report_json(const BenchReport& report) {
    nlohmann::ordered_json levels = nlohmann::ordered_json::array();
    for (const BenchLevel& level : report.levels) {
        nlohmann::ordered_json grids = nlohmann::ordered_json::array();
        for (const BenchGrid& grid : level.grids) {
            nlohmann::ordered_json json = {{"mapping", name(grid.benchmark.grid.mapping)},
                                           {"size", size_text(grid.benchmark.grid)},
                                           {"samples", sample_count(grid.benchmark.grid)}};
            add(json, "peak_bytes", grid.peak_bytes);
            nlohmann::ordered_json rows = nlohmann::ordered_json::array();
            for (const Row& row : rows_of(grid)) rows.push_back(row_json(row, level, grid));
            json["timings"] = std::move(rows);
            grids.push_back(std::move(json));
        }
        levels.push_back({{"level", level.level},
                          {"vertices", level.vertices},
                          {"triangles", level.triangles},
                          {"model_bytes", level.model_bytes},
                          {"maps", std::move(grids)}});
    }
    nlohmann::ordered_json json = {{"sample", "boot"}, {"runs", report.runs}};
    if (!report.gl.empty()) json["gl"] = report.gl;
    json["levels"] = std::move(levels);
    return json;
}

std::string report_text(const BenchReport& report) {
    std::string text =
        "Milliseconds, median of " + std::to_string(report.runs) + (report.runs == 1 ? " run" : " runs") +
        ", ± half the range. Ratio: how many times as long the slower one takes.\n"
        "ns: of radial hits, per triangle and sample.\n\n" +
        pad_right("", 28) + "            hits                           crossings\n" + heading_titles +
        "      radial      Embree  ratio      radial      Embree  ratio    ns\n";
    text += table(report, [](const BenchLevel& level, const BenchGrid& grid, const Row& row) {
        return column(time_text(row.radial_hits), 12) + column(time_text(row.embree_hits), 12) +
               column(ratio_text(ratio(row.embree_hits, row.radial_hits)), 7) +
               column(time_text(row.radial), 12) + column(time_text(row.embree), 12) +
               column(ratio_text(ratio(row.embree, row.radial)), 7) +
               column(row.radial_hits ? fixed(nanoseconds(*row.radial_hits, level, grid), 1) : "-", 6);
    });
    text += "\n" + pad_right("", 28) + "               crossings                      radial bake\n" +
            heading_titles + "       orbit           naive  ratio     1 layer    2 layers   peak\n";
    text += table(report, [](const BenchLevel& level, const BenchGrid& grid, const Row& row) {
        const std::optional<double> peak =
            grid.peak_bytes ? std::optional(double(*grid.peak_bytes) / double(level.model_bytes))
                            : std::nullopt;
        return column(time_text(row.orbit), 12) + column(time_text(row.naive), 16) +
               column(ratio_text(ratio(row.naive, row.orbit)), 7) + column(time_text(row.bake_1), 12) +
               column(time_text(row.bake_2), 12) + column(ratio_text(peak), 7);
    });
    if (!report.gl.empty()) text += "\n" + report.gl + "\n";
    return text;
}

} // namespace spa::tools
