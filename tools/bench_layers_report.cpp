// SPDX-License-Identifier: Apache-2.0
#include "bench_layers_report.h"

#include "bake_settings.h"
#include "text.h"

#include <algorithm>
#include <vector>

namespace spa::tools {

namespace {

using measure::LayerFigures;
using measure::LayerRow;
using measure::LayersBar;
using measure::LayersBenchmark;
using measure::LayersMesh;
using measure::Reconstruction;

constexpr std::size_t name_width = 10;
constexpr std::size_t text_width = 108;

// Of 100.
// The bar is at 0.005 %, and the column narrow.
std::string interior_text(double share) { return fixed(100 * share, share < 0.1 ? 4 : 3); }

std::string share_text(double share) { return share == 0 ? "0" : significant(100 * share, 3); }
std::string distance_text(double distance) { return significant(distance, 2); }
std::string kibibytes(double bytes) {
    constexpr double kibi = 1024;
    return fixed(bytes / kibi, bytes < 9.95 * kibi ? 1 : 0);
}

std::string counted(std::uint64_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

// width: of a column with the space before it.
struct Column {
    const char* title;
    std::size_t width;
};
constexpr Column columns[] = {{"K", 2},     {"N", 5},     {"false%", 7}, {"miss%", 7},
                              {"in f%", 7}, {"in m%", 7}, {"mean", 8},   {"p95", 8},
                              {"p99", 8},   {"deg", 6},   {"ns", 5},     {"x K=1", 6},
                              {"KiB", 5},   {"folds", 6}, {"mixed%", 7}, {"tang%", 6}};

std::string titles(const std::string& first) {
    std::string text = pad_right(first, name_width);
    for (const Column& column : columns) text += pad_left(column.title, column.width);
    return text + "\n";
}

std::string line_of(const LayerFigures& row) {
    const std::string cells[] = {
        row.reconstruction == Reconstruction::one_depth ? "-" : std::to_string(row.layers),
        std::to_string(row.cells),
        share_text(row.false_hits),
        share_text(row.missed_hits),
        interior_text(row.interior_false),
        interior_text(row.interior_missed),
        distance_text(row.distance_mean),
        distance_text(row.distance_p95),
        distance_text(row.distance_p99),
        significant(row.normal_mean, 3),
        fixed(row.ns, 0),
        row.time_ratio ? fixed(*row.time_ratio, 2) : "-",
        kibibytes(row.file_bytes),
        row.reconstruction == Reconstruction::folds ? kibibytes(row.fold_bytes) : "-",
        share_text(row.mixed_triangles),
        row.reconstruction == Reconstruction::folds ? share_text(row.tangent_triangles) : "-"};
    std::string text = pad_right(title(row.reconstruction), name_width);
    for (std::size_t i = 0; i < std::size(columns); ++i) text += pad_left(cells[i], columns[i].width);
    return text + "\n";
}

std::string table(const std::vector<LayerFigures>& rows) {
    std::string text = titles("");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i > 0 && rows[i].cells != rows[i - 1].cells) text += "\n";
        text += line_of(rows[i]);
    }
    return text + "\n";
}

std::string paragraph(const std::string& text) {
    std::string result;
    for (const std::string& line : wrap_text(text, text_width)) result += line + "\n";
    return result;
}

std::string mesh_text(const LayersMesh& mesh) {
    const LayersBenchmark& b = mesh.benchmark;
    std::vector<LayerFigures> rows;
    for (const LayerRow& row : b.rows) rows.push_back(figures_of(row));
    const std::string shape =
        b.closed() ? "closed" : "open: " + counted(b.open_edges, "edge", "edges") + " without a partner";
    std::string text = mesh.name + ": " + counted(b.triangles, "triangle", "triangles") + " in " +
                       counted(b.components, "piece", "pieces") + ", " + shape + "\n" + table(rows);
    if (!b.closed()) text += paragraph(losses_text(b)) + "\n";
    return text;
}

std::string bar_value(const LayersBar& bar, double value) {
    return bar.unit == "share" ? significant(100 * value, 3) + " %"
                               : significant(value, 3) + (bar.unit == "times" ? "x" : " " + bar.unit);
}

std::string bar_line(const LayersBar& bar) {
    std::string text = pad_right(bar.name, 37) +
                       pad_right((bar.worst_size ? "worst size, N=" : "N=") + std::to_string(bar.cells), 20) +
                       pad_left(bar_value(bar, bar.value), 11) + (bar.at_least ? " >= " : " <= ") +
                       pad_right(bar_value(bar, bar.limit), 10) +
                       pad_right(bar.reached() ? "reached" : "MISSED", 8);
    if (!bar.mesh.empty())
        text += bar.mesh;
    else
        text += bar.worst_mesh + " " + bar_value(bar, bar.worst);
    return text + "\n";
}

std::string bars_text(const std::vector<LayersBar>& bars) {
    if (bars.empty()) return "";
    std::string text = "Bars: folds, two intervals, mean of the closed meshes; at the end the mesh that is "
                       "farthest off\n";
    for (const LayersBar& bar : bars) text += bar_line(bar);
    return text;
}

constexpr const char* legend =
    "one depth: the outermost surface, solid to the centre. tangents, folds: K intervals; where neighbouring "
    "samples see different surfaces, joined by the planes of stored normals, or by fold records.\n\n"
    "Random chords of the sphere, % of all of them: false: the map alone is hit; miss: the mesh alone is; in "
    "f, in m: those of them that no silhouette passes within two texels of 2/N R. mean, p95, p99: |dt| in R "
    "where both are hit; deg: between normals. ns: a ray of a stream, one thread, median; x K=1: of each "
    "run, to "
    "one interval of the same kind, median. KiB: the file; folds: how much larger fold records make it; "
    "mixed: of the map's triangles; tang: of these, what folds leave to tangent planes.\n\n";

} // namespace

std::string losses_text(const LayersBenchmark& benchmark) {
    if (benchmark.closed()) return {};
    const LayerRow* judged = nullptr;
    std::vector<std::uint32_t> cells, layers;
    for (const LayerRow& row : benchmark.rows) {
        if (row.reconstruction != Reconstruction::folds) continue;
        cells.push_back(row.cells);
        layers.push_back(row.layers);
    }
    if (!cells.empty())
        judged =
            benchmark.find(Reconstruction::folds, measure::usual_layers(layers), measure::usual_cells(cells));
    if (judged == nullptr) return {};
    const LayerFigures figures = figures_of(*judged);
    const double samples = (double(judged->cells) + 1) * (double(judged->cells) + 1);
    const auto share = [&](std::uint64_t count) {
        return significant(100 * double(count) / samples, 2) + " % of the samples";
    };
    const bake::Report& bake = judged->bake;
    std::string text = "Lost at N=" + std::to_string(judged->cells) + " with " +
                       counted(judged->layers, "interval", "intervals") + ": ";
    text += bake.truncated_samples == 0
                ? "no sample has more surface than that holds"
                : share(bake.truncated_samples) + " have more surface than that holds";
    if (bake.unseen_components > 0)
        text += "; " + std::to_string(bake.unseen_components) + " of " +
                counted(bake.components, "piece", "pieces") + " met no sample";
    text += bake.thin_samples == 0 ? ". No sample holds surface that bounds no solid."
                                   : ". " + share(bake.thin_samples) +
                                         " hold surface that bounds no solid, stored as thin shells.";
    text += " Rays that pass the map where the mesh is hit: " + share_text(figures.missed_hits) + " %, " +
            share_text(figures.interior_missed) +
            " % away from silhouettes; hit where it is not: " + share_text(figures.false_hits) + " %, " +
            share_text(figures.interior_false) + " % away from silhouettes.";
    const std::uint32_t most = *std::max_element(layers.begin(), layers.end());
    const LayerRow* const more = benchmark.find(Reconstruction::folds, most, judged->cells);
    if (most > judged->layers && more != nullptr) {
        const LayerFigures best = figures_of(*more);
        text += " With " + std::to_string(most) + " intervals " + share_text(best.missed_hits) +
                " % are missed and " + share_text(best.false_hits) + " % false; " +
                share(more->bake.truncated_samples) + " have more still.";
    }
    return text;
}

std::string report_text(const LayersReport& report) {
    std::string text = paragraph(legend);
    text += std::to_string(report.rays) + " rays a mesh, " + counted(report.runs, "run", "runs") +
            ", streams by " + report.target + ", centre by " + name(report.center) + "\n\n";
    for (const LayersMesh& mesh : report.meshes) text += mesh_text(mesh);
    if (measure::closed_count(report.meshes) > 1)
        text += "Mean of " + counted(measure::closed_count(report.meshes), "closed mesh", "closed meshes") +
                "\n" + table(report.mean);
    return text + bars_text(report.bars);
}

} // namespace spa::tools
