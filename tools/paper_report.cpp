// SPDX-License-Identifier: Apache-2.0
#include "paper_report.h"

#include "paper_printed.h"
#include "text.h"

#include <nlohmann/json.hpp>

namespace spa::tools {
namespace {

using Json = nlohmann::ordered_json;

double frames_per_second(const PaperCell& cell) { return 1 / cell.seconds; }

double ratio_to_triangles(const PaperTables& tables, const PaperCell& cell) {
    const PaperCell* const triangles = tables.find(cell.level, triangles_name, cell.samples);
    return triangles == nullptr ? 0 : triangles->seconds / cell.seconds;
}

// The paper's own ratio.
std::optional<double> printed_ratio(const PaperCell& cell) {
    const auto cell_fps = printed_frames_per_second(cell.level, cell.method, cell.samples);
    const auto triangles = printed_frames_per_second(cell.level, triangles_name, cell.samples);
    if (!cell_fps || !triangles) return {};
    return *cell_fps / *triangles;
}

Json cell_json(const PaperTables& tables, const PaperCell& cell) {
    Json json = {{"level", cell.level},
                 {"method", cell.method},
                 {"samples", cell.samples},
                 {"frames_per_second", frames_per_second(cell)},
                 {"ratio_to_triangles", ratio_to_triangles(tables, cell)},
                 {"secondary_rays", cell.secondary_rays},
                 {"secondary_seconds", cell.secondary_seconds},
                 {"relmse", cell.relmse},
                 {"relmse_equal_seeds", cell.relmse_equal_seeds}};
    if (const auto printed = printed_frames_per_second(cell.level, cell.method, cell.samples)) {
        json["printed_frames_per_second"] = *printed;
        json["printed_ratio_to_triangles"] = printed_ratio(cell).value_or(0);
    }
    return json;
}

Json costs_json(const PaperCosts& costs) {
    Json json = {{"level", costs.level},
                 {"vertices", costs.vertices},
                 {"triangles", costs.triangles},
                 {"triangle_bytes", costs.triangle_bytes},
                 {"triangle_structure_bytes", costs.triangle_structure_bytes},
                 {"map_bytes", costs.map_bytes},
                 {"map_structure_bytes", costs.map_structure_bytes},
                 {"triangle_build_seconds", costs.triangle_build_seconds},
                 {"map_load_seconds", costs.map_load_seconds},
                 {"triangle_first_frame_seconds", costs.triangle_first_frame},
                 {"map_first_frame_seconds", costs.map_first_frame},
                 {"glb_bytes", costs.glb_bytes},
                 {"spa_bytes", costs.spa_bytes},
                 {"map_distance", {{"mean", costs.map_mean}, {"median", costs.map_median}}}};
    const auto add = [&](const char* key, const std::optional<PaperCosts::LodRates>& lod) {
        if (lod)
            json[key] = {{"triangles", lod->triangles},
                         {"distance", {{"mean", lod->mean}, {"median", lod->median}}},
                         {"secondary_rays_a_second", lod->rays_a_second}};
    };
    add("lod_by_mean", costs.lod_by_mean);
    add("lod_by_median", costs.lod_by_median);
    return json;
}

std::vector<std::uint32_t> samples_of(const PaperTables& tables) {
    std::vector<std::uint32_t> samples;
    for (const PaperCell& cell : tables.cells)
        if (std::find(samples.begin(), samples.end(), cell.samples) == samples.end())
            samples.push_back(cell.samples);
    return samples;
}

std::string column(const std::string& text, std::size_t width = 9) { return pad_left(text, width); }

// One of the paper's tables: a row a method; for each number of samples the frames per second with the ratio
// to triangles, and below them the same as printed, and the error.
std::string table_text(const PaperTables& tables, const PaperCosts& costs) {
    const std::vector<std::uint32_t> samples = samples_of(tables);
    std::string text =
        "boot level " + std::to_string(costs.level) + ", " + std::to_string(costs.vertices) +
        " vertices: frames a second (times triangles) | the paper's | relMSE of the indirect light\n";
    text += pad_right("", 20);
    for (const std::uint32_t n : samples) text += column("n = " + std::to_string(n), 16);
    text += " |";
    for (const std::uint32_t n : samples) text += column(std::to_string(n), 15);
    text += " |";
    for (const std::uint32_t n : samples) text += column(std::to_string(n), 9);
    text += '\n';
    for (const PaperMethod& method : paper_methods()) {
        text += pad_right(method.name, 20);
        std::string printed, error;
        for (const std::uint32_t n : samples) {
            const PaperCell* const cell = tables.find(costs.level, method.name, n);
            if (cell == nullptr) return "";
            text += column(significant(frames_per_second(*cell), 3) + " (" +
                               significant(ratio_to_triangles(tables, *cell), 3) + "x)",
                           16);
            const auto fps = printed_frames_per_second(costs.level, method.name, n);
            printed += column(
                fps ? significant(*fps, 4) + " (" + significant(*printed_ratio(*cell), 3) + "x)" : "-", 15);
            error += column(significant(cell->relmse, 2));
        }
        text += " |" + printed + " |" + error + '\n';
    }
    return text;
}

std::string triangles_text(const std::optional<PaperCosts::LodRates>& lod) {
    return lod ? std::to_string(lod->triangles) : "none";
}

std::string costs_text(const PaperTables& tables) {
    std::string text =
        "what the object costs on the device, as triangles and as a map of one layer\n"
        "level  triangles   memory: triangles + structure        map + structure   build     load"
        "   file to first frame: triangles  map   simplified meshes of equal mean, median |dt|\n";
    for (const PaperCosts& costs : tables.costs) {
        text +=
            pad_left(std::to_string(costs.level), 5) + pad_left(std::to_string(costs.triangles), 11) +
            pad_left(byte_count(costs.triangle_bytes) + " + " + byte_count(costs.triangle_structure_bytes),
                     31) +
            pad_left(byte_count(costs.map_bytes) + " + " + byte_count(costs.map_structure_bytes), 23) +
            pad_left(fixed(costs.triangle_build_seconds, 3) + " s", 10) +
            pad_left(fixed(costs.map_load_seconds, 3) + " s", 9) +
            pad_left(fixed(costs.triangle_first_frame, 2) + " s", 22) +
            pad_left(fixed(costs.map_first_frame, 2) + " s", 13) +
            pad_left(triangles_text(costs.lod_by_mean) + ", " + triangles_text(costs.lod_by_median), 28) +
            '\n';
    }
    return text;
}

} // namespace

Json report_json(const PaperReport& report) {
    Json json = {
        {"device", report.device},      {"driver", report.driver},        {"backend", report.backend},
        {"width", report.tables.width}, {"height", report.tables.height}, {"cells", Json::array()},
        {"costs", Json::array()},       {"figures", Json::array()},       {"bars", Json::array()}};
    for (const PaperCell& cell : report.tables.cells) json["cells"].push_back(cell_json(report.tables, cell));
    for (const PaperCosts& costs : report.tables.costs) json["costs"].push_back(costs_json(costs));
    for (const FigureError& error : report.figures)
        json["figures"].push_back({{"figure", error.figure},
                                   {"scene", error.scene},
                                   {"method", error.method},
                                   {"relmse", error.relmse},
                                   {"psnr", error.psnr}});
    for (const PaperBar& bar : report.bars)
        json["bars"].push_back({{"bar", bar.name},
                                {"value", bar.value},
                                {"limit", bar.limit},
                                {"kind", bar.at_least ? "at least" : "at most"},
                                {"reached", bar.reached()}});
    return json;
}

std::string report_text(const PaperReport& report) {
    std::string text = report.device + ", " + report.driver + ", by " + report.backend + "\n";
    if (!report.tables.cells.empty())
        text += std::to_string(report.tables.width) + " x " + std::to_string(report.tables.height) +
                " pixels\n\n";
    for (const PaperCosts& costs : report.tables.costs) text += table_text(report.tables, costs) + '\n';
    if (!report.tables.costs.empty()) text += costs_text(report.tables) + '\n';
    std::string figure;
    for (const FigureError& error : report.figures) {
        if (error.figure + error.scene != figure) text += error.figure + ", " + error.scene + "\n";
        figure = error.figure + error.scene;
        text += "  " + pad_right(error.method, 20) + "relMSE " + pad_left(significant(error.relmse, 3), 9) +
                "   PSNR " + fixed(error.psnr, 1) + " dB\n";
    }
    if (!report.bars.empty()) text += "\nto reach\n";
    for (const PaperBar& bar : report.bars)
        text += std::string(bar.reached() ? "  reached  " : "  MISSED   ") + significant(bar.value, 3) +
                " (" + (bar.at_least ? "at least " : "at most ") + significant(bar.limit, 3) + ")  " +
                bar.name + "\n";
    return text;
}

std::string report_csv(const PaperReport& report) {
    std::string text = "level,method,samples,frames_per_second,ratio_to_triangles,printed_frames_per_second,"
                       "printed_ratio_to_triangles,secondary_rays_a_second,relmse,relmse_equal_seeds\n";
    const auto optional = [](const std::optional<double>& value) {
        return value ? significant(*value, 6) : std::string();
    };
    for (const PaperCell& cell : report.tables.cells)
        text += std::to_string(cell.level) + "," + cell.method + "," + std::to_string(cell.samples) + "," +
                significant(frames_per_second(cell), 6) + "," +
                significant(ratio_to_triangles(report.tables, cell), 6) + "," +
                optional(printed_frames_per_second(cell.level, cell.method, cell.samples)) + "," +
                optional(printed_ratio(cell)) + "," +
                significant(double(cell.secondary_rays) / cell.secondary_seconds, 6) + "," +
                significant(cell.relmse, 6) + "," + significant(cell.relmse_equal_seeds, 6) + "\n";
    return text;
}

} // namespace spa::tools
