// SPDX-License-Identifier: Apache-2.0
#include "bench_trace_plots.h"

#include "bench_models.h"
#include "gnuplot.h"
#include "text.h"

#include <algorithm>
#include <array>
#include <functional>

namespace spa::tools {

namespace {

using measure::CallKind;
using measure::Family;
using measure::MethodReport;
using measure::RaySet;
using measure::SetErrors;
using measure::TraceTiming;

constexpr unsigned threads = 1;

struct Point {
    double ns = 0, bytes = 0, error = 0;
    std::string label;
};

struct Series {
    std::string title;
    std::string style; // of gnuplot: colour, point and line
    std::vector<Point> points;
};

// The time of one kind of call, or of the faster.
enum class Time : std::uint8_t { single, stream, fastest };

const TraceTiming* timing_of(const MethodReport& method, Time time) {
    switch (time) {
    case Time::single: return method.timing(RaySet::chords, threads, CallKind::single);
    case Time::stream: return method.timing(RaySet::chords, threads, CallKind::stream);
    case Time::fastest: break;
    }
    return method.fastest(RaySet::chords, threads);
}

std::string label_of(const MethodReport& method) {
    if (method.family == Family::fan) return method.name.substr(4);
    if (method.family == Family::projective || method.family == Family::surface)
        return std::to_string(method.cells);
    return "";
}

Series series_of(const TraceModel& model, const std::string& title, const std::string& style, Time time,
                 const std::function<bool(const MethodReport&)>& belongs) {
    Series series{title, style, {}};
    for (const MethodReport& method : model.benchmark.methods) {
        const SetErrors* const errors = method.errors_of(RaySet::chords);
        const TraceTiming* const timing = timing_of(method, time);
        if (!belongs(method) || errors == nullptr || timing == nullptr) continue;
        constexpr double rounding = 1e-7; // what has no more error than that is exact
        if (!(errors->errors.distance.mean > rounding)) continue;
        series.points.push_back(
            {timing->ns.median, double(method.bytes), errors->errors.distance.mean, label_of(method)});
    }
    return series;
}

std::vector<Series> all_series(const TraceModel& model) {
    const auto projective = [](std::uint32_t layers) {
        return
            [layers](const MethodReport& m) { return m.family == Family::projective && m.layers == layers; };
    };
    const auto family = [](Family wanted) {
        return [wanted](const MethodReport& m) { return m.family == wanted; };
    };
    std::vector<Series> all{
        series_of(model, "map, stream, 1 layer", "lc rgb '#d7301f' pt 7 lw 2", Time::stream, projective(1)),
        series_of(model, "map, stream, 2 layers", "lc rgb '#fc8d59' pt 6 lw 2", Time::stream, projective(2)),
        series_of(model, "map, single rays, 1 layer", "lc rgb '#d7301f' pt 5 lw 1 dt 2", Time::single,
                  projective(1)),
        series_of(model, "simplified mesh, Embree", "lc rgb '#2b8cbe' pt 9 lw 2", Time::fastest,
                  family(Family::lod)),
        series_of(model, "map's surface as mesh, Embree", "lc rgb '#74a9cf' pt 11 lw 1 dt 2", Time::fastest,
                  family(Family::surface)),
        series_of(model, "paper's fan, N rays", "lc rgb '#636363' pt 13 lw 1", Time::fastest,
                  family(Family::fan)),
        series_of(model, "march", "lc rgb '#31a354' pt 3 lw 1", Time::fastest, family(Family::march)),
    };
    std::erase_if(all, [](const Series& series) { return series.points.empty(); });
    // The paper's rule for N stands among fixed ones; it is no step of their ladder.
    for (Series& series : all)
        std::erase_if(series.points, [](const Point& p) { return p.label == "N(d2)"; });
    return all;
}

std::string data_block(const std::string& name, const Series& series) {
    std::string text = "$" + name + " << END\n";
    for (const Point& p : series.points)
        text += significant(p.ns, 6) + " " + significant(p.bytes / 1024, 6) + " " + significant(p.error, 6) +
                " \"" + p.label + "\"\n";
    return text + "END\n";
}

// What one of the two panels shows to the right.
struct Axis {
    const char* title;
    int column; // of the data
    bool with_key;
};

std::string plot_command(const std::vector<Series>& series, const Axis& axis) {
    std::string text = "plot ";
    for (std::size_t i = 0; i < series.size(); ++i) {
        const std::string data =
            "$series" + std::to_string(i) + " using " + std::to_string(axis.column) + ":3";
        if (i > 0) text += ", \\\n     ";
        text += data + " with linespoints " + series[i].style + " title " + gnuplot_text(series[i].title);
        // The sizes stand beside the streams of one layer, and N beside the fan.
        if (i == 0 || series[i].title.starts_with("paper"))
            text += ", \\\n     " + data + ":4 with labels offset 0.9,0.6 font ',9' notitle";
    }
    return text + "\n";
}

double value_of(const Point& point, const Axis& axis) {
    return axis.column == 1 ? point.ns : point.bytes / 1024;
}

// Where the model's own triangles stand, whose error is none; 0: they were not measured.
double mesh_value(const TraceModel& model, const Axis& axis) {
    const MethodReport* const mesh = model.benchmark.find("mesh");
    const TraceTiming* const timing = mesh == nullptr ? nullptr : timing_of(*mesh, Time::fastest);
    return timing == nullptr ? 0 : value_of({timing->ns.median, double(mesh->bytes), 0, ""}, axis);
}

std::string range(const char* name, double low, double high) {
    return std::string("set ") + name + " [" + significant(low, 4) + ":" + significant(high, 4) + "]\n";
}

std::string panel(const TraceModel& model, const std::vector<Series>& series, const Axis& axis) {
    const double mesh = mesh_value(model, axis);
    double low = mesh > 0 ? mesh : 1e30, high = mesh, least = 1e30, most = 0;
    for (const Series& s : series) {
        for (const Point& p : s.points) {
            low = std::min(low, value_of(p, axis));
            high = std::max(high, value_of(p, axis));
            least = std::min(least, p.error);
            most = std::max(most, p.error);
        }
    }
    std::string text = range("xrange", low / 1.5, high * 1.8) + range("yrange", least / 2, most * 2.5) +
                       "set xlabel '" + axis.title + "'\n";
    if (mesh > 0) {
        const std::string x = significant(mesh, 6);
        text += "set arrow 1 from first " + x + ", graph 0 to first " + x +
                ", graph 1 nohead lc rgb '#2b8cbe' lw 1 dt 4\n"
                "set label 1 'the model itself, Embree' at first " +
                x + ", graph 0.03 rotate by 90 offset -1.1,0 font ',9' tc rgb '#2b8cbe'\n";
    }
    return text + (axis.with_key ? "" : "unset key\n") + plot_command(series, axis) +
           "unset arrow\nunset label\n";
}

std::string script_of(const TraceModel& model) {
    std::vector<Series> series = all_series(model);
    if (series.empty()) return "";
    std::string text = "set terminal pngcairo size 1280,660 font 'Sans,11' background rgb 'white'\n"
                       "set encoding utf8\n";
    for (std::size_t i = 0; i < series.size(); ++i)
        text += data_block("series" + std::to_string(i), series[i]);
    text += "set multiplot title " +
            gnuplot_text(model.name + ", " + std::to_string(model.benchmark.triangles) +
                         " triangles: random chords, one thread") +
            " font ',13' noenhanced\n"
            "set logscale xy\n"
            "set format y '10^{%T}'\n"
            "set grid xtics ytics lc rgb '#dddddd' lt 1\n"
            "set border 3\nset tics nomirror\n"
            "set bmargin at screen 0.2\nset tmargin at screen 0.92\n"
            "set lmargin at screen 0.07\nset rmargin at screen 0.5\n"
            "set ylabel 'mean |dt| where both are hit, in R'\n";
    // The key is as wide as both panels: it is drawn with the left one and centred in the middle.
    text += "set key at screen 0.5, screen 0.06 center center maxrows 2 font ',10'\n";
    text += "set xtics (10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000)\n";
    text += panel(model, series, {"nanoseconds a ray", 1, true});
    text += "set xtics autofreq\nset lmargin at screen 0.56\nset rmargin at screen 0.99\nset ylabel ''\n";
    text += panel(model, series, {"what tracing may touch, KiB", 2, false}) + "unset multiplot\n";
    return text;
}

} // namespace

std::vector<Plot> trace_plots(const TraceReport& report) {
    std::vector<Plot> plots;
    for (const TraceModel& model : report.models) {
        Plot plot{"trace-" + bench_file_name(model.name), script_of(model)};
        if (!plot.script.empty()) plots.push_back(std::move(plot));
    }
    return plots;
}

} // namespace spa::tools
