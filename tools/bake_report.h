// SPDX-License-Identifier: Apache-2.0
// What `spa bake` says about a bake: in the file (metadata) and on standard output.
// Schema of the latter: ../formats/schemas/bake.schema.json.
#pragma once

#include "bake_arguments.h"

#include "../formats/import/import.h"
#include "../libspa/bake/bake_parts.h"
#include "../libspa/measure/measure_parts.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace spa::tools {

// Everything the reports are made from. The references outlive it.
struct BakeFacts {
    const BakeArguments& arguments;
    const import::Result& source;
    const Partition& partition;
    const std::vector<bake::Report>& part_reports;     // one a piece
    const std::vector<Part>& parts;                    // the same
    const bake::Report& bake;                          // of all
    const measure::Measurement* measurement = nullptr; // null: not measured
};

// Compact JSON, UTF-8: generator, source, options, report, figures (if measured), units. The same for the
// same input and options, wherever the input lies and whatever the machine: no path, no time, no name of a
// machine or driver.
std::string metadata(const BakeFacts& facts);

// bake_key.h, of these facts; "key" in the metadata.
std::string bake_key(const BakeFacts& facts);

// The warnings of the import and of the bake, in this order.
std::vector<std::string> warnings(const BakeFacts& facts);

// output: {"path", "bytes", "sections": [...]}.
nlohmann::ordered_json report_json(const BakeFacts& facts, nlohmann::ordered_json output, double seconds);
// For people; does not repeat the warnings.
std::string report_text(const BakeFacts& facts, std::uint64_t output_bytes, double seconds);

} // namespace spa::tools
