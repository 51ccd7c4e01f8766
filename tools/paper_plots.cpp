// SPDX-License-Identifier: Apache-2.0
#include "paper_report.h"

#include "text.h"

#include <map>

namespace spa::tools {
namespace {

struct Style {
    const char* method;
    const char* gnuplot;
};
constexpr Style styles[] = {
    {"triangles", "lc rgb '#2b8cbe' pt 9 lw 2"},
    {"projective", "lc rgb '#d7301f' pt 7 lw 2"},
    {"projective 2 layers", "lc rgb '#fc8d59' pt 6 lw 2"},
    {"fan 0", "lc rgb '#cccccc' pt 4 lw 1"},
    {"fan 1", "lc rgb '#bdbdbd' pt 13 lw 1"},
    {"fan 3", "lc rgb '#969696' pt 12 lw 1"},
    {"fan 5", "lc rgb '#636363' pt 11 lw 1"},
    {"fan 10", "lc rgb '#252525' pt 10 lw 1"},
    {"fan N(d2)", "lc rgb '#31a354' pt 3 lw 1"},
};

const char* const head =
    "set encoding utf8\nset grid lc rgb '#dddddd' lt 1\nset border 3\nset tics nomirror\n"
    "set format y '%g'\n";

std::string block(const std::string& name, const std::string& lines) {
    return "$" + name + " << END\n" + lines + "END\n";
}

// As Fig. 7 of the paper: vertices against frames a second, on logarithmic axes.
std::string frames_script(const PaperTables& tables) {
    std::map<std::uint32_t, std::map<std::string, std::string>> panels;
    std::map<int, std::uint64_t> vertices;
    for (const PaperCosts& costs : tables.costs) vertices[costs.level] = costs.vertices;
    for (const PaperCell& cell : tables.cells)
        panels[cell.samples][cell.method] +=
            std::to_string(vertices[cell.level]) + " " + significant(1 / cell.seconds, 6) + "\n";
    std::string text = "set terminal pngcairo size 1280,900 font 'Sans,10' background rgb 'white'\n";
    text += head;
    for (const auto& [samples, series] : panels)
        for (std::size_t i = 0; i < std::size(styles); ++i)
            if (series.contains(styles[i].method))
                text += block("p" + std::to_string(samples) + "_" + std::to_string(i),
                              series.at(styles[i].method));
    text += std::string("set multiplot layout ") + (panels.size() > 2 ? "2,2" : "1,2") +
            " title 'Frames a second against vertices of the boot'\nset logscale xy\n"
            "set xlabel 'vertices'\nset ylabel 'frames a second'\nset key outside right\n";
    for (const auto& [samples, series] : panels) {
        text += "set title '" + std::to_string(samples) + " secondary rays a pixel'\nplot ";
        bool first = true;
        for (std::size_t i = 0; i < std::size(styles); ++i) {
            if (!series.contains(styles[i].method)) continue;
            text += (first ? "" : ", \\\n     ") + std::string("$p") + std::to_string(samples) + "_" +
                    std::to_string(i) + " with linespoints " + styles[i].gnuplot + " title '" +
                    styles[i].method + "'";
            first = false;
        }
        text += "\n";
    }
    return text + "unset multiplot\n";
}

// Time of a frame with the most samples against its error, one point a level.
std::string error_script(const PaperTables& tables) {
    std::uint32_t most = 0;
    for (const PaperCell& cell : tables.cells) most = std::max(most, cell.samples);
    std::map<std::string, std::string> series;
    for (const PaperCell& cell : tables.cells)
        if (cell.samples == most && cell.relmse_equal_seeds > 0)
            series[cell.method] +=
                significant(double(cell.secondary_seconds) * 1e9 / double(cell.secondary_rays), 6) + " " +
                significant(cell.relmse_equal_seeds, 6) + " " + std::to_string(cell.level) + "\n";
    std::string text = "set terminal pngcairo size 900,640 font 'Sans,11' background rgb 'white'\n";
    text += head;
    for (std::size_t i = 0; i < std::size(styles); ++i)
        if (series.contains(styles[i].method))
            text += block("s" + std::to_string(i), series.at(styles[i].method));
    text += "set title 'Indirect light, " + std::to_string(most) +
            " rays a pixel; one point a level of the boot'\n"
            "set logscale xy\nset format y '10^{%T}'\nset xlabel 'nanoseconds a secondary ray, its shadow "
            "ray included'\n"
            "set ylabel 'relMSE against triangles with the same directions'\nset key outside right\nplot ";
    bool first = true;
    for (std::size_t i = 0; i < std::size(styles); ++i) {
        if (!series.contains(styles[i].method)) continue;
        text += (first ? "" : ", \\\n     ") + std::string("$s") + std::to_string(i) +
                " using 1:2 with points " + styles[i].gnuplot + " title '" + styles[i].method + "'";
        first = false;
    }
    return text + "\n";
}

} // namespace

std::vector<PaperPlot> paper_plots(const PaperReport& report) {
    if (report.tables.cells.empty()) return {};
    return {{"fig7-frames", frames_script(report.tables)},
            {"speed-against-error", error_script(report.tables)}};
}

} // namespace spa::tools
