// SPDX-License-Identifier: Apache-2.0
#include "bench_trace_report.h"

#include "text.h"

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

// RFC 4180: quoted where a comma, a quote or a line break asks for it.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

void append(std::string& line, const std::string& text) { line += (line.empty() ? "" : ",") + field(text); }
void append(std::string& line, std::uint64_t number) { append(line, std::to_string(number)); }
void append(std::string& line, double number) { append(line, significant(number, 6)); }

std::string line_of(const TraceModel& model, const MethodReport& method, const SetErrors& set,
                    const TraceTiming& timing) {
    const RayErrors& e = set.errors;
    std::string line;
    append(line, model.name);
    append(line, method.name);
    append(line, std::string(measure::name(method.family)));
    append(line, std::uint64_t(method.cells));
    append(line, std::uint64_t(method.layers));
    append(line, method.triangles);
    append(line, method.bytes);
    append(line, method.file ? method.file->bytes : std::uint64_t(0));
    append(line, std::string(measure::name(set.set)));
    append(line, std::uint64_t(timing.threads));
    append(line, std::string(timing.kind == CallKind::single ? "single" : "stream"));
    append(line, timing.call);
    for (const double ns : {timing.ns.median, timing.ns.min, timing.ns.max}) append(line, ns);
    for (const std::uint64_t count :
         {e.rays(), e.band.missed, e.band.extra, e.interior.missed, e.interior.extra})
        append(line, count);
    for (const double error : {e.distance.mean, e.distance.median, e.distance.p95, e.distance.p99,
                               e.distance.max, e.normal.mean, e.color.mean})
        append(line, error);
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
