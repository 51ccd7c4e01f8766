// SPDX-License-Identifier: Apache-2.0
// What became of the assets of a batch, as text and as JSON (schema: ../formats/schemas/batch.schema.json).
#pragma once

#include "batch_arguments.h"
#include "batch_assets.h"
#include "up_to_date.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace spa::tools {

enum class AssetStatus : std::uint8_t {
    not_started, // or interrupted: the next run does it
    baked,       // dry run: would be
    up_to_date,
    failed,
};
const char* name(AssetStatus status);

struct AssetResult {
    AssetStatus status = AssetStatus::not_started;
    BakeReason reason = BakeReason::none; // of a bake
    ExitCode exit_code = ExitCode::ok;
    int signal = 0;    // that ended the process; 0 = none
    std::string error; // begins with a path
    std::string diagnostics;
    std::vector<std::string> warnings;
    double seconds = 0;
    std::uint64_t peak_memory_bytes = 0;
    MapFacts facts; // of a map that is there
};

// Why a batch ended before its assets did.
enum class BatchStop : std::uint8_t { none, signal, output };

struct BatchReport {
    const BatchArguments& arguments;
    const std::vector<BatchAsset>& assets;
    BatchSettings& settings;
    std::vector<AssetResult> results; // of each asset
    std::vector<std::string> warnings;
    BatchStop stopped_by = BatchStop::none;
    double seconds = 0;

    // By AssetStatus.
    [[nodiscard]] std::array<std::size_t, 4> counts() const;
    // That of the first asset that failed; ok if none did.
    [[nodiscard]] ExitCode exit_code() const;
};

nlohmann::ordered_json batch_json(const BatchReport& report);
// For people: the counts, what failed and why, what it cost.
std::string batch_text(const BatchReport& report);

// One line: what a file name or a message may have that a terminal or a line does not bear (control
// characters, bytes that are not UTF-8) is written as \n, \x1b and so on.
std::string one_line(std::string_view text);

// "SIGSEGV", or "signal 64" for those without a name.
std::string signal_name(int number);

} // namespace spa::tools
