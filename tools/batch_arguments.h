// SPDX-License-Identifier: Apache-2.0
// The arguments of `spa batch`.
#pragma once

#include "arguments.h"
#include "batch_assets.h"
#include "batch_config.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

struct BatchArguments {
    AssetQuery query;
    std::filesystem::path plan; // whose objects are baked, and not query.inputs; empty: none
    BatchConfig config;
    GivenSettings command_line; // bake options
    unsigned jobs = 1;
    unsigned threads = 1; // of each job
    std::uint64_t memory_bytes = 0;
    std::optional<std::chrono::seconds> timeout;
    bool keep_going = false, force = false, dry_run = false;
    std::vector<std::filesystem::path> reports; // .json or .html
    ReportFormat format = ReportFormat::text;
    bool quiet = false;
};

// Adds the options to the parser. The function returned is called after parsing, while `app` lives. It throws
// Error: usage where arguments are wrong, and what read_batch_config does.
std::function<BatchArguments()> define_batch_arguments(CLI::App& app);

// "I/N", I from 1 to N, where 0/N means N/N; or "auto": from the environment of Slurm, of Kubernetes, or of
// SPA_SHARD_INDEX and SPA_SHARD_COUNT. variable: getenv, or a test's. Throws Error{usage}.
Shard parse_shard(const std::string& text, const std::function<const char*(const char*)>& variable);

} // namespace spa::tools
