// SPDX-License-Identifier: Apache-2.0
#include "bench_trace_report.h"

#include "bench_json.h"

#include <nlohmann/json.hpp>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;
using measure::Bar;
using measure::CallKind;
using measure::ErrorParts;
using measure::MethodReport;
using measure::RayErrors;
using measure::SetErrors;
using measure::TraceTiming;

Json to_json(const ErrorParts& parts) {
    Json json = {{"E_star", parts.star}, {"E_res", parts.resolution}, {"E_quant", parts.quantization}};
    if (parts.solver) json["E_solver"] = *parts.solver;
    json["total"] = parts.total;
    return json;
}

Json set_json(const MethodReport& method, const SetErrors& set) {
    const RayErrors& e = set.errors;
    Json json = {{"set", measure::name(set.set)},
                 {"band_width", set.band_width},
                 {"band", confusion_json(e.band)},
                 {"interior", confusion_json(e.interior)}};
    if (!measure::asks_occlusion(set.set)) {
        json["distance"] = full_distribution_json(e.distance);
        json["interior_distance"] = full_distribution_json(e.interior_distance);
        if (e.normal.count > 0) json["normal_angle"] = full_distribution_json(e.normal);
        if (e.color.count > 0) json["color_difference"] = full_distribution_json(e.color);
    }
    Json times = Json::array();
    for (const TraceTiming& timing : method.timings) {
        if (timing.set != set.set) continue;
        times.push_back({{"threads", timing.threads},
                         {"kind", timing.kind == CallKind::single ? "single" : "stream"},
                         {"call", timing.call},
                         {"ns", spread_json(timing.ns)}});
    }
    json["times"] = std::move(times);
    return json;
}

Json method_json(const MethodReport& method) {
    Json json = {{"method", method.name}, {"family", measure::name(method.family)}};
    if (method.cells != 0) json["cells"] = method.cells;
    if (method.layers != 0) json["layers"] = method.layers;
    if (method.triangles != 0) json["triangles"] = method.triangles;
    if (method.target_error > 0) json["target_error"] = method.target_error;
    json["bytes"] = method.bytes;
    if (method.file)
        json["file"] = {{"bytes", method.file->bytes}, {"first_ray", spread_json(method.file->first_ray)}};
    if (method.build_seconds) json["build_seconds"] = *method.build_seconds;
    if (method.build_seconds_cores) json["build_seconds_all_cores"] = *method.build_seconds_cores;
    if (method.parts) json["error_parts"] = to_json(*method.parts);
    Json sets = Json::array();
    for (const SetErrors& set : method.errors) sets.push_back(set_json(method, set));
    json["sets"] = std::move(sets);
    return json;
}

Json equal_json(const EqualError& equal) {
    return {{"method", equal.map->name},
            {"ns", equal.ns},
            {"bytes", equal.map->bytes},
            {"missed_silhouettes", equal.missed},
            {"lod_ns", equal.lod.ns},
            {"lod_bytes", equal.lod.bytes},
            {"lod_missed_silhouettes", equal.lod.missed},
            {"speed_ratio", equal.lod.ns / equal.ns},
            {"bytes_ratio", equal.lod.bytes / double(equal.map->bytes)}};
}

Json bar_json(const Bar& bar) {
    Json json = {{"bar", bar.name},    {"model", bar.model},       {"method", bar.method},
                 {"value", bar.value}, {"limit", bar.limit},       {"at_least", bar.at_least},
                 {"unit", bar.unit},   {"reached", bar.reached()}, {"missed_silhouettes", bar.missed}};
    if (bar.rival_missed) json["rival_missed_silhouettes"] = *bar.rival_missed;
    return json;
}

} // namespace

Json report_json(const TraceReport& report) {
    Json models = Json::array(), bars = Json::array();
    for (const TraceModel& model : report.models) {
        Json methods = Json::array(), equal = Json::array();
        for (const MethodReport& method : model.benchmark.methods) methods.push_back(method_json(method));
        for (const EqualError& e : equal_errors(model)) equal.push_back(equal_json(e));
        for (const Bar& bar : model.bars) bars.push_back(bar_json(bar));
        models.push_back({{"model", model.name},
                          {"vertices", model.benchmark.vertices},
                          {"triangles", model.benchmark.triangles},
                          {"simplify_seconds", model.benchmark.simplify_seconds},
                          {"methods", std::move(methods)},
                          {"equal_error_lods", std::move(equal)}});
    }
    return {{"rays", report.rays},
            {"runs", report.runs},
            {"stream_target", report.target},
            {"models", std::move(models)},
            {"bars", std::move(bars)}};
}

} // namespace spa::tools
