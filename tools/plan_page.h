// SPDX-License-Identifier: Apache-2.0
// A plan as one page for a browser: a table of all objects with bars for their bytes, largest first. It holds
// all it shows, runs no script and asks no network for anything, whatever the names in the plan.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spa::tools {

// plan: as formats/schemas/plan.schema.json says; strings may hold any bytes, and those that are not UTF-8
// are shown as U+FFFD.
std::string plan_page(const nlohmann::ordered_json& plan);

} // namespace spa::tools
