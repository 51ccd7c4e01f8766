// SPDX-License-Identifier: Apache-2.0
// The arguments of `spa bench`, as given: what a word means depends on what is measured.
#pragma once

#include "arguments.h"

#include "../libspa/bake/bake_options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

struct BenchArguments {
    std::vector<std::string> assets;
    std::optional<std::string> levels, models, sizes, layers, rays, seed, threads, runs, only, sets;
    std::optional<bake::Center> center;
    std::filesystem::path csv, plots, out; // empty: none
    std::string device, sponza;
    bool quick = false;
    ReportFormat format = ReportFormat::text;
    bool quiet = false;
};

constexpr unsigned max_runs = 1000;
constexpr unsigned max_threads = 1024;
constexpr std::uint32_t max_side = 16384;

// At commas, or whatever the separator is; "" is one empty part.
std::vector<std::string> split(const std::string& text, char separator);
// Numbers divided by commas. Throws Error{usage} whose message starts with `option`.
std::vector<std::uint32_t> parse_numbers(const std::string& option, const std::string& text,
                                         std::uint32_t lowest, std::uint32_t highest);
// The cells a side of octahedral maps, which are even. Throws as parse_numbers.
std::vector<std::uint32_t> parse_cells(const std::string& option, const std::string& text);
// Throws Error{usage} if an option was given that `what` does not know.
void refuse(const std::string& what, const char* option, bool given);

void refuse_paper_options(const std::string& what, const BenchArguments& given);
void refuse_layers_options(const std::string& what, const BenchArguments& given);

// A level of the samples, or A..B. Throws Error{usage}.
std::vector<int> parse_levels(const std::string& text);

// `spa bench bake`, `spa bench trace`, `spa bench layers` and `spa bench paper`, the last where Vulkan was
// built.
void bench_bake(const BenchArguments& arguments);
void bench_trace(const BenchArguments& arguments);
void bench_layers(const BenchArguments& arguments);
void bench_paper(const BenchArguments& arguments);

} // namespace spa::tools
