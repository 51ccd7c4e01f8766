// SPDX-License-Identifier: Apache-2.0
#include "bench_trace_report.h"

#include "text.h"

#include <algorithm>

namespace spa::tools {

namespace {

using measure::Bar;
using measure::CallKind;
using measure::Distribution;
using measure::Family;
using measure::MethodReport;
using measure::RayErrors;
using measure::RaySet;
using measure::SetErrors;
using measure::Spread;
using measure::TraceTiming;

std::string nanoseconds_text(double ns) { return fixed(ns, ns < 99.95 ? 1 : 0); }

// Nanoseconds with three digits, and half the range of all runs as a share of the median.
std::string time_text(const TraceTiming* timing) {
    if (timing == nullptr) return "-";
    const Spread& ns = timing->ns;
    const double half_range = ns.median > 0 ? (ns.max - ns.min) / 2 / ns.median : 0;
    return nanoseconds_text(ns.median) + "±" + pad_left(fixed(half_range * 100, 0), 2) + "%";
}

std::string size_text(std::uint64_t bytes) {
    constexpr double kibi = 1024;
    const double size = double(bytes) / kibi;
    return size < 999.5 ? fixed(size, size < 9.95 ? 1 : 0) + " K" : fixed(size / kibi, 1) + " M";
}

// Of 100 rays.
std::string share_text(double share) { return share == 0 ? "0" : significant(100 * share, 2); }
std::string share_text(std::uint64_t count, std::uint64_t of) {
    return share_text(of == 0 ? 0 : double(count) / double(of));
}

std::string ratio_text(double value) { return fixed(value, value < 9.95 ? 1 : 0); }

// pad_left, for text in which "±" is one column and two bytes.
std::string column(const std::string& text, std::size_t width) {
    return pad_left(text, width + (text.find("±") == std::string::npos ? 0 : 1));
}

constexpr std::size_t name_width = 16;

std::string set_titles(const TraceReport& report, RaySet set) {
    std::string text = pad_right(std::string(measure::name(set)) + " rays", name_width) + column("bytes", 7) +
                       column("single", 10) + column("stream", 10);
    if (set == RaySet::chords)
        for (std::size_t i = 1; i < report.threads.size(); ++i)
            text += column("x " + std::to_string(report.threads[i]), 6);
    text += column("miss%", 6) + column("extra%", 7) + column("inside", 8);
    if (!measure::asks_occlusion(set))
        for (const char* const title : {"mean", "median", "p95", "p99", "max"}) text += column(title, 8);
    return text + "\n";
}

std::string set_line(const TraceReport& report, const MethodReport& method, const SetErrors& set) {
    const RayErrors& e = set.errors;
    std::string text = pad_right(method.name, name_width) + column(size_text(method.bytes), 7);
    const unsigned threads = report.threads.front();
    for (const CallKind kind : {CallKind::single, CallKind::stream})
        text += column(time_text(method.timing(set.set, threads, kind)), 10);
    if (set.set == RaySet::chords) {
        for (std::size_t i = 1; i < report.threads.size(); ++i) {
            const TraceTiming* const timing = method.fastest(set.set, report.threads[i]);
            text += column(timing == nullptr ? "-" : nanoseconds_text(timing->ns.median), 6);
        }
    }
    text += column(share_text(e.band.missed, e.rays()), 6) + column(share_text(e.band.extra, e.rays()), 7) +
            column(std::to_string(e.interior.missed) + "/" + std::to_string(e.interior.extra), 8);
    if (measure::asks_occlusion(set.set)) return text + "\n";
    const Distribution& d = e.distance;
    for (const double value : {d.mean, d.median, d.p95, d.p99, d.max})
        text += column(significant(value, 2), 8);
    return text + "\n";
}

std::string set_table(const TraceReport& report, const TraceModel& model, RaySet set) {
    std::string lines;
    for (const MethodReport& method : model.benchmark.methods)
        if (const SetErrors* const errors = method.errors_of(set)) lines += set_line(report, method, *errors);
    return lines.empty() ? "" : set_titles(report, set) + lines + "\n";
}

std::string seconds_text(double seconds) { return significant(seconds * 1e3, 3); }

// What is not a matter of the set of rays, and what only chords are asked for.
std::string other_table(const TraceModel& model) {
    std::string text = pad_right("", name_width) + column("file", 8) + column("first ray", 10) +
                       column("build", 8) + column("normal", 9) + column("p95", 9) + column("colour", 8) +
                       column("E_star", 9) + column("E_res", 9) + column("E_quant", 9) +
                       column("E_solver", 10) + "\n";
    for (const MethodReport& method : model.benchmark.methods) {
        const SetErrors* const set = method.errors_of(RaySet::chords);
        const RayErrors errors = set == nullptr ? RayErrors{} : set->errors;
        const auto part = [&](double measure::ErrorParts::*member) {
            return method.parts ? significant((*method.parts).*member, 2) : std::string("-");
        };
        text +=
            pad_right(method.name, name_width) +
            column(method.file ? size_text(method.file->bytes) : "-", 8) +
            column(method.file ? seconds_text(method.file->first_ray.median) : "-", 10) +
            column(method.build_seconds ? seconds_text(*method.build_seconds) : "-", 8) +
            column(errors.normal.count > 0 ? significant(errors.normal.mean, 3) : "-", 9) +
            column(errors.normal.count > 0 ? significant(errors.normal.p95, 3) : "-", 9) +
            column(errors.color.count > 0 ? significant(errors.color.mean, 2) : "-", 8) +
            column(part(&measure::ErrorParts::star), 9) + column(part(&measure::ErrorParts::resolution), 9) +
            column(part(&measure::ErrorParts::quantization), 9) +
            column(method.parts && method.parts->solver ? significant(*method.parts->solver, 2) : "-", 10) +
            "\n";
    }
    return text + "\n";
}

std::string equal_table(const TraceModel& model) {
    const std::vector<EqualError> all = equal_errors(model);
    if (all.empty()) return "";
    std::string text =
        "Maps and the simplified mesh of equal mean |dt|, between two steps, or the model itself\n" +
        pad_right("", name_width) + column("ns", 7) + column("LOD", 7) + column("bytes", 9) +
        column("LOD", 9) + column("speed", 8) + column("size", 8) + column("miss%", 8) + column("LOD", 7) +
        "  faster smaller\n";
    for (const EqualError& e : all) {
        const double speed = e.lod.ns / e.ns;
        const double size = e.lod.bytes / double(e.map->bytes);
        text += pad_right(e.map->name, name_width) + column(nanoseconds_text(e.ns), 7) +
                column(nanoseconds_text(e.lod.ns), 7) + column(size_text(e.map->bytes), 9) +
                column(size_text(std::uint64_t(e.lod.bytes)), 9) + column(ratio_text(speed) + "x", 8) +
                column(ratio_text(size) + "x", 8) + column(share_text(e.missed), 8) +
                column(share_text(e.lod.missed), 7) + "  " + pad_right(speed >= 1 ? "map" : "LOD", 7) +
                (size >= 1 ? "map" : "LOD") + "\n";
    }
    return text + "\n";
}

std::string bar_line(const Bar& bar) {
    std::string text = pad_right(bar.name, 33) + pad_right(bar.model, 9) + " " + pad_right(bar.method, 16) +
                       pad_left(significant(bar.value, 3), 9) + (bar.at_least ? " >= " : " <= ") +
                       pad_right(significant(bar.limit, 3) + " " + bar.unit, 10) +
                       pad_right(bar.reached() ? "reached" : "MISSED", 8) + share_text(bar.missed);
    if (bar.rival_missed) text += " (rival " + share_text(*bar.rival_missed) + ")";
    return text + "\n";
}

// The same bar of several models stands together: a smooth shape beside one with edges.
std::string bars_table(const TraceReport& report) {
    std::vector<Bar> bars;
    std::vector<std::string> names;
    for (const TraceModel& model : report.models) {
        for (const Bar& bar : model.bars) {
            bars.push_back(bar);
            if (std::find(names.begin(), names.end(), bar.name) == names.end()) names.push_back(bar.name);
        }
    }
    if (bars.empty()) return "";
    std::string text = "Bars: chords, one thread; at the end the silhouettes missed, in % of the rays\n";
    for (const std::string& name : names)
        for (const Bar& bar : bars)
            if (bar.name == name) text += bar_line(bar);
    return text;
}

constexpr const char* legend =
    "Nanoseconds a ray, median, ± half the range. single: a call a ray; stream: the fastest call for many.\n"
    "bytes: what tracing may touch (K, M: 1024, 1024^2). miss%, extra%: of 100 rays, those that miss though\n"
    "the model is hit and the other way round, within two texels of a silhouette (of 128 cells, where a\n"
    "method has none of its own); inside: number of both farther from it. mean .. max: |dt| in R.\n"
    "file: bytes; first ray, build: milliseconds, one thread; normal: degrees, colour: of 255; E_...: in "
    "R.\n\n";

} // namespace

std::vector<EqualError> equal_errors(const TraceModel& model) {
    std::vector<EqualError> result;
    for (const MethodReport& method : model.benchmark.methods) {
        if (method.family != Family::projective) continue;
        const SetErrors* const set = method.errors_of(RaySet::chords);
        const TraceTiming* const timing = method.fastest(RaySet::chords, 1);
        if (set == nullptr || timing == nullptr) continue;
        const auto lod = measure::equal_lod(model.benchmark, set->errors.distance.mean, 1);
        if (!lod) continue;
        result.push_back(
            {&method, timing->ns.median, double(set->errors.band.missed) / double(set->errors.rays()), *lod});
    }
    return result;
}

std::string report_text(const TraceReport& report) {
    std::string text = legend;
    for (const TraceModel& model : report.models) {
        text += model.name + ": " + std::to_string(model.benchmark.vertices) + " vertices, " +
                std::to_string(model.benchmark.triangles) + " triangles; " + std::to_string(report.rays) +
                " rays of each set, " + std::to_string(report.runs) + (report.runs == 1 ? " run" : " runs") +
                ", streams by " + report.target + "\n\n";
        for (const RaySet set : measure::ray_sets()) text += set_table(report, model, set);
        text += other_table(model) + equal_table(model);
    }
    return text + bars_table(report);
}

} // namespace spa::tools
