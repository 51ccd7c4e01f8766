// SPDX-License-Identifier: Apache-2.0
// What `spa bench bake` says. Schema of the JSON: ../formats/schemas/bench-bake.schema.json.
#pragma once

#include "../libspa/measure/bench_bake.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

struct BenchGrid {
    measure::BakeBenchmark benchmark;
    std::optional<std::uint64_t> peak_bytes; // measure::peak_bake_bytes with two layers
};

struct BenchLevel {
    std::uint32_t level = 0; // of the boot
    std::uint64_t vertices = 0, triangles = 0;
    std::uint64_t model_bytes = 0;
    std::vector<BenchGrid> grids;
};

struct BenchReport {
    std::string gl; // GlContext::description(); empty: the orbit was not timed
    unsigned runs = 0;
    std::vector<BenchLevel> levels;
};

nlohmann::ordered_json report_json(const BenchReport& report);
// Two tables, at most 100 columns wide.
std::string report_text(const BenchReport& report);

} // namespace spa::tools
