// SPDX-License-Identifier: Apache-2.0
#include "bench_trace_report.h"

#include "csv.h"

#include <algorithm>

namespace spa::tools {

namespace {

using measure::CallKind;
using measure::MethodReport;
using measure::RayErrors;
using measure::SetErrors;
using measure::TraceTiming;

constexpr const char* titles =
    "model,method,family,cells,layers,triangles,bytes,file_bytes,set,threads,kind,call,ns_median,ns_min,ns_"
    "max,"
    "rays,band_missed,band_extra,interior_missed,interior_extra,distance_mean,distance_median,distance_p95,"
    "distance_p99,distance_max,normal_mean,color_mean\n";

std::string line_of(const TraceModel& model, const MethodReport& method, const SetErrors& set,
                    const TraceTiming& timing) {
    const RayErrors& e = set.errors;
    std::string line;
    append_field(line, model.name);
    append_field(line, method.name);
    append_field(line, std::string(measure::name(method.family)));
    append_field(line, std::uint64_t(method.cells));
    append_field(line, std::uint64_t(method.layers));
    append_field(line, method.triangles);
    append_field(line, method.bytes);
    append_field(line, method.file ? method.file->bytes : std::uint64_t(0));
    append_field(line, std::string(measure::name(set.set)));
    append_field(line, std::uint64_t(timing.threads));
    append_field(line, std::string(timing.kind == CallKind::single ? "single" : "stream"));
    append_field(line, timing.call);
    for (const double ns : {timing.ns.median, timing.ns.min, timing.ns.max}) append_field(line, ns);
    for (const std::uint64_t count :
         {e.rays(), e.band.missed, e.band.extra, e.interior.missed, e.interior.extra})
        append_field(line, count);
    for (const double error : {e.distance.mean, e.distance.median, e.distance.p95, e.distance.p99,
                               e.distance.max, e.normal.mean, e.color.mean})
        append_field(line, error);
    return line + "\n";
}

} // namespace

std::string report_csv(const TraceReport& report) {
    std::string text = titles;
    for (const TraceModel& model : report.models) {
        for (const MethodReport& method : model.benchmark.methods) {
            for (const TraceTiming& timing : method.timings) {
                const SetErrors* const set = method.errors_of(timing.set);
                if (set != nullptr) text += line_of(model, method, *set, timing);
            }
        }
    }
    return text;
}

} // namespace spa::tools
