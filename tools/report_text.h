// SPDX-License-Identifier: Apache-2.0
// The report of many maps as text for people.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spa::tools {

// A line a map, then a line a plan. report: as formats/schemas/report.schema.json says.
std::string report_text(const nlohmann::ordered_json& report);

} // namespace spa::tools
