// SPDX-License-Identifier: Apache-2.0
// How much memory a batch may use, and how much a bake will want.
#pragma once

#include "bake_settings.h"

#include <cstdint>
#include <string>

namespace spa::tools {

// "512M", "8G", "1536K", "1T" or bytes; K is 1024. Throws Error{usage} whose message starts with `option`.
std::uint64_t parse_byte_count(const std::string& option, const std::string& text);

// Three quarters of what the machine, or the control group (version 2) that this process is in, has left.
std::uint64_t default_memory_budget();

// What baking an asset whose files have `source_bytes` takes, generously. It decides how many bakes run at
// once; a bake that needs more than was estimated gets another try with all of the budget.
std::uint64_t estimated_memory(std::uint64_t source_bytes, const BakeSettings& settings);

} // namespace spa::tools
