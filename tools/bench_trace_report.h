// SPDX-License-Identifier: Apache-2.0
// What `spa bench trace` says. Schema of the JSON: ../formats/schemas/bench-trace.schema.json.
#pragma once

#include "../libspa/measure/bench_trace.h"
#include "../libspa/measure/trace_bars.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

struct TraceModel {
    std::string name; // as given
    measure::TraceBenchmark benchmark;
    std::vector<measure::Bar> bars;
};

struct TraceReport {
    std::uint32_t rays = 0;
    unsigned runs = 0;
    std::vector<unsigned> threads;
    std::string target; // the instruction set of streams
    std::vector<TraceModel> models;
};

// A map and the simplified mesh of equal error beside it; chords, one thread, streams or whatever is faster.
struct EqualError {
    const measure::MethodReport* map = nullptr;
    double ns = 0, missed = 0; // of the map
    measure::EqualLod lod;
};
// Of every projective method that has one.
std::vector<EqualError> equal_errors(const TraceModel& model);

nlohmann::ordered_json report_json(const TraceReport& report);
// Tables of at most 110 columns.
std::string report_text(const TraceReport& report);
// A title line, then one line a model, method, set of rays, number of threads and kind of call.
std::string report_csv(const TraceReport& report);

} // namespace spa::tools
