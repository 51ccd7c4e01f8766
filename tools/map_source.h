// SPDX-License-Identifier: Apache-2.0
// The asset that a map was baked from, as its metadata names it.
#pragma once

#include "map_file.h"

#include "../formats/import/import.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

// Where the metadata's source lies if it lies beside the file: same folder, the name alone. Empty if there is
// none, or the file is standard input.
std::filesystem::path source_beside(const MapFile& file);
// The same in another folder.
std::filesystem::path source_in(const std::filesystem::path& folder, const MapFile& file);

// The node of the source that the map was baked from, as the metadata's options name it; none: all of it.
std::optional<std::uint32_t> source_node(const MapFile& file);

// Which of the files that the model was read from are not those that the map was baked from, by name. None if
// the metadata does not say what it was baked from.
std::optional<std::vector<std::string>> differing_files(const MapFile& file, const import::Report& source);

} // namespace spa::tools
