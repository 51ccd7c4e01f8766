// SPDX-License-Identifier: Apache-2.0
// What `spa inspect` says about a file. Schema of the JSON: ../formats/schemas/inspect.schema.json.
#pragma once

#include "map_file.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spa::tools {

nlohmann::ordered_json inspect_json(const MapFile& file);
std::string inspect_text(const MapFile& file);

// {"type", "part", "layer", ...} for every section of the table; also part of the report of `spa bake`.
nlohmann::ordered_json sections_json(std::span<const container::SectionEntry> sections);

} // namespace spa::tools
