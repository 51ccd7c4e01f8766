// SPDX-License-Identifier: Apache-2.0
// What `spa bench trace` says. Schema of the JSON: ../formats/schemas/bench-trace.schema.json.
#pragma once

#include "../libspa/measure/bench_trace.h"
#include "../libspa/measure/trace_bars.h"

#include <nlohmann/json.hpp>

#include <cstdint>
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
    std::string target; // the instruction set of streams
    std::vector<TraceModel> models;
};

nlohmann::ordered_json report_json(const TraceReport& report);
// Tables of at most 110 columns.
std::string report_text(const TraceReport& report);
// A title line, then one line a model, method, set, number of threads and kind of call.
std::string report_csv(const TraceReport& report);

} // namespace spa::tools
