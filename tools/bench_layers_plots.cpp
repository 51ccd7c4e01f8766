// SPDX-License-Identifier: Apache-2.0
#include "bench_layers_plots.h"

#include "gnuplot.h"
#include "text.h"

#include <algorithm>

namespace spa::tools {

namespace {

using measure::LayerFigures;
using measure::LayersBar;
using measure::Reconstruction;

struct Panel {
    const char* title;
    const char* bar; // the name of its bars
    double LayerFigures::*value;
    double scale; // of the value, for the axis
};
constexpr Panel panels[] = {
    {"false hits, % of the rays", "false hits", &LayerFigures::false_hits, 100},
    {"missed hits, % of the rays", "missed hits", &LayerFigures::missed_hits, 100},
    {"mean |dt| where both are hit, in R", "mean |dt|", &LayerFigures::distance_mean, 1}};

struct Series {
    Reconstruction reconstruction;
    std::uint32_t layers;
    const char* style; // of gnuplot
};
constexpr Series all_series[] = {
    {Reconstruction::one_depth, 1, "lc rgb '#636363' pt 13 lw 2"},
    {Reconstruction::tangents, 1, "lc rgb '#a6bddb' pt 8 lw 1 dt 2"},
    {Reconstruction::tangents, 2, "lc rgb '#2b8cbe' pt 9 lw 2"},
    {Reconstruction::tangents, 3, "lc rgb '#045a8d' pt 11 lw 1 dt 4"},
    {Reconstruction::folds, 1, "lc rgb '#fdbb84' pt 6 lw 1 dt 2"},
    {Reconstruction::folds, 2, "lc rgb '#d7301f' pt 7 lw 2"},
    {Reconstruction::folds, 3, "lc rgb '#7f0000' pt 5 lw 1 dt 4"},
};

std::string title_of(const Series& series) {
    return series.reconstruction == Reconstruction::one_depth
               ? title(series.reconstruction)
               : std::string(title(series.reconstruction)) + ", K=" + std::to_string(series.layers);
}

// "N value" a line; a logarithmic axis has no zero.
std::string lines_of(const std::vector<LayerFigures>& rows, const Series& series, const Panel& panel) {
    std::string text;
    for (const LayerFigures& row : rows)
        if (row.reconstruction == series.reconstruction && row.layers == series.layers &&
            row.*panel.value > 0)
            text += std::to_string(row.cells) + " " + significant(row.*panel.value * panel.scale, 6) + "\n";
    return text;
}

std::string lines_of(const std::vector<LayersBar>& bars, const Panel& panel) {
    std::string text;
    for (const LayersBar& bar : bars)
        if (bar.name == panel.bar && !bar.worst_size)
            text += std::to_string(bar.cells) + " " + significant(bar.limit * panel.scale, 6) + "\n";
    return text;
}

std::string panel_text(const std::vector<LayerFigures>& rows, const std::vector<LayersBar>& bars,
                       std::size_t index) {
    const Panel& panel = panels[index];
    std::string data, plot;
    const auto add = [&](const std::string& name, const std::string& lines, const std::string& style) {
        if (lines.empty()) return;
        data += "$" + name + " << END\n" + lines + "END\n";
        plot += (plot.empty() ? "plot $" : ", \\\n     $") + name + " using 1:2 with " + style;
    };
    const std::string prefix = "p" + std::to_string(index) + "_";
    for (std::size_t i = 0; i < std::size(all_series); ++i)
        add(prefix + std::to_string(i), lines_of(rows, all_series[i], panel),
            std::string("linespoints ") + all_series[i].style + " title " +
                gnuplot_text(title_of(all_series[i])));
    add(prefix + "bars", lines_of(bars, panel), "points pt 2 ps 1.6 lw 2 lc rgb 'black' title 'bar, K=2'");
    if (plot.empty()) return "";
    // The titles stand once, below all three.
    const std::string key =
        index == 1 ? "set key at screen 0.5, screen 0.07 center center maxrows 2\n" : "unset key\n";
    const auto screen = [&](double x) { return fixed(double(index) * 0.325 + x, 3); };
    return data + key + "set lmargin at screen " + screen(0.06) + "\nset rmargin at screen " + screen(0.335) +
           "\nset title " + gnuplot_text(panel.title) + "\n" + plot + "\n";
}

std::string script_of(const std::string& title, const std::vector<LayerFigures>& rows,
                      const std::vector<LayersBar>& bars) {
    std::string text;
    for (std::size_t i = 0; i < std::size(panels); ++i) text += panel_text(rows, bars, i);
    if (text.empty()) return "";
    const auto [least, most] =
        std::minmax_element(rows.begin(), rows.end(),
                            [](const LayerFigures& a, const LayerFigures& b) { return a.cells < b.cells; });
    return "set terminal pngcairo size 1280,560 font 'Sans,10' background rgb 'white'\n"
           "set encoding utf8\nset multiplot title " +
           gnuplot_text(title) +
           " font ',13' noenhanced\nset logscale xy\nset format y '%g'\n"
           "set grid xtics ytics lc rgb '#dddddd' lt 1\nset border 3\nset tics nomirror\n"
           "set xtics (16, 32, 64, 128, 256, 512, 1024, 2048)\n"
           "set xrange [" +
           significant(least->cells / 1.3, 4) + ":" + significant(most->cells * 1.3, 4) +
           "]\n"
           "set xlabel 'N, cells a side of the map'\n"
           "set bmargin at screen 0.24\nset tmargin at screen 0.86\n" +
           text + "unset multiplot\n";
}

} // namespace

std::vector<Plot> layers_plots(const LayersReport& report) {
    std::vector<Plot> plots;
    const auto add = [&](const std::string& name, std::string script) {
        if (!script.empty()) plots.push_back({name, std::move(script)});
    };
    const std::size_t closed = measure::closed_count(report.meshes);
    if (closed > 1)
        add("layers-mean", script_of("Mean of " + std::to_string(closed) + " closed meshes: random chords",
                                     report.mean, report.bars));
    for (const measure::LayersMesh& mesh : report.meshes) {
        std::vector<LayerFigures> rows;
        for (const measure::LayerRow& row : mesh.benchmark.rows) rows.push_back(figures_of(row));
        add("layers-" + mesh.name, script_of(mesh.name + ", " + std::to_string(mesh.benchmark.triangles) +
                                                 " triangles: random chords",
                                             rows, {}));
    }
    return plots;
}

} // namespace spa::tools
