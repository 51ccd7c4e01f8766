// SPDX-License-Identifier: Apache-2.0
#include "memory_budget.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>

namespace spa::tools {

namespace {

constexpr std::uint64_t mebibyte = 1ULL << 20U;

// The number in a file of one, such as those of control groups ("max": none).
std::optional<std::uint64_t> number_in(const char* path) {
    std::ifstream file(path);
    std::uint64_t value = 0;
    if (!(file >> value)) return {};
    return value;
}

std::uint64_t available_memory() {
    std::ifstream file("/proc/meminfo");
    std::string label;
    std::uint64_t kibibytes = 0;
    while (file >> label >> kibibytes) {
        if (label == "MemAvailable:") return kibibytes << 10U;
        file.ignore(64, '\n');
    }
    return 4096 * mebibyte;
}

} // namespace

std::uint64_t parse_byte_count(const std::string& option, const std::string& text) {
    constexpr std::string_view units = "KMGT";
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    std::size_t shift = 0;
    bool right = error == std::errc{} && value > 0;
    if (right && stopped != end) {
        const std::size_t unit = units.find(*stopped);
        shift = 10 * (unit + 1);
        right = unit != std::string_view::npos && stopped + 1 == end && value <= (UINT64_MAX >> shift);
    }
    if (!right)
        throw Error(ExitCode::usage, option + ": '" + text + "' is not a size such as 8G, 512M or 4096K");
    return value << shift;
}

std::uint64_t default_memory_budget() {
    std::uint64_t left = available_memory();
    const auto limit = number_in("/sys/fs/cgroup/memory.max");
    const auto used = number_in("/sys/fs/cgroup/memory.current");
    if (limit) left = std::min(left, *limit - std::min(*limit, used.value_or(0)));
    return left / 4 * 3;
}

std::uint64_t estimated_memory(std::uint64_t source_bytes, const BakeSettings& settings) {
    const bake::Options& options = settings.options;
    const auto samples = [](const Grid& grid) { return std::uint64_t(grid.width) * grid.height; };
    const std::uint64_t map = (samples(options.grid) + samples(options.color_grid)) * options.layers * 2 * 16;
    return 128 * mebibyte + 16 * source_bytes + 3 * map;
}

} // namespace spa::tools
