// SPDX-License-Identifier: Apache-2.0
#include "bench_trace_report.h"

#include "text.h"

#include <algorithm>

namespace spa::tools {

namespace {

using measure::Bar;
using measure::CallKind;
using measure::Confusion;
using measure::Family;
using measure::MethodReport;
using measure::RayErrors;
using measure::RaySet;
using measure::SetErrors;
using measure::Spread;
using measure::TraceTiming;

// Nanoseconds with three digits, and half the range of all runs as a share of the median.
std::string time_text(const TraceTiming* timing) {
    if (timing == nullptr) return "-";
    const Spread& ns = timing->ns;
    const double half_range = ns.median > 0 ? (ns.max - ns.min) / 2 / ns.median : 0;
    return fixed(ns.median, ns.median < 99.95 ? 1 : 0) + " ±" + pad_left(fixed(half_range * 100, 0), 2) + "%";
}

// pad_left, for text in which "±" is one column and two bytes.
std::string column(const std::string& text, std::size_t width) {
    return pad_left(text, width + (text.find("±") == std::string::npos ? 0 : 1));
}

// Per million rays, so that sets of different sizes compare.
std::string share_text(std::uint64_t count, std::uint64_t of) {
    return count == 0 ? "0" : significant(100.0 * double(count) / double(of), 2);
}

std::string set_table(const TraceModel& model, RaySet set) {
    std::string text;
    for (const MethodReport& method : model.benchmark.methods) {
        const SetErrors* const errors = method.errors_of(set);
        if (errors == nullptr) continue;
        const RayErrors& e = errors->errors;
        std::string line = pad_right(method.name, 17) + column(byte_count(method.bytes), 11) +
                           column(time_text(method.timing(set, 1, CallKind::single)), 12) +
                           column(time_text(method.timing(set, 1, CallKind::stream)), 12);
        line += column(share_text(e.band.missed, e.rays()), 8) +
                column(share_text(e.band.extra, e.rays()), 8) + column(std::to_string(e.interior.missed), 6) +
                column(std::to_string(e.interior.extra), 6);
        if (!measure::asks_occlusion(set))
            line += column(significant(e.distance.mean, 2), 10) +
                    column(significant(e.distance.median, 2), 10) + column(significant(e.distance.p99, 2), 9);
        text += line + "\n";
    }
    return text;
}

std::string heading(RaySet set) {
    std::string text = std::string(measure::name(set)) + " rays\n" + pad_right("method", 17) +
                       column("bytes", 11) + column("single", 12) + column("stream", 12) +
                       column("missed", 8) + column("extra", 8) + column("miss", 6) + column("extr", 6);
    if (!measure::asks_occlusion(set))
        text += column("mean dt", 10) + column("median", 10) + column("p99", 9);
    return text + "\n";
}

std::string bar_text(const Bar& bar) {
    std::string line = pad_right(bar.reached() ? "reached" : "missed", 9) + pad_right(bar.model, 10) +
                       pad_right(bar.method, 18) + pad_right(bar.name, 37) +
                       pad_left(significant(bar.value, 3), 8) + (bar.at_least ? " >= " : " <= ") +
                       significant(bar.limit, 3) + " " + bar.unit + "; silhouettes missed " +
                       significant(100 * bar.missed, 2) + " %";
    if (bar.rival_missed) line += ", rival's " + significant(100 * *bar.rival_missed, 2) + " %";
    return line + "\n";
}

} // namespace

nlohmann::ordered_json report_json(const TraceReport& report) { return {{"rays", report.rays}}; }

std::string report_csv(const TraceReport&) { return ""; }

std::string report_text(const TraceReport& report) {
    std::string text;
    for (const TraceModel& model : report.models) {
        text += model.name + ": " + std::to_string(model.benchmark.vertices) + " vertices, " +
                std::to_string(model.benchmark.triangles) + " triangles\n\n";
        for (const RaySet set : measure::ray_sets()) {
            const std::string table = set_table(model, set);
            if (!table.empty()) text += heading(set) + table + "\n";
        }
        for (const MethodReport& method : model.benchmark.methods) {
            if (method.family == Family::mesh && method.build_seconds)
                text += "build " + significant(*method.build_seconds * 1e3, 3) + " ms\n";
            if (method.file)
                text += method.name + " file " + byte_count(method.file->bytes) + ", first ray " +
                        significant(method.file->first_ray.median * 1e3, 3) + " ms\n";
            if (method.parts)
                text += method.name + " E_star " + significant(method.parts->star, 3) + " E_res " +
                        significant(method.parts->resolution, 3) + " E_quant " +
                        significant(method.parts->quantization, 3) + " E_solver " +
                        (method.parts->solver ? significant(*method.parts->solver, 3) : "-") + " total " +
                        significant(method.parts->total, 3) + "\n";
        }
        for (const Bar& bar : model.bars) text += bar_text(bar);
        text += "\n";
    }
    return text;
}

} // namespace spa::tools
