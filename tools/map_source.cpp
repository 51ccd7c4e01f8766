// SPDX-License-Identifier: Apache-2.0
#include "map_source.h"

#include "text.h"

#include <nlohmann/json.hpp>

#include <system_error>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

// A member of the metadata, which anybody may have written: null where it is not there.
Json member(const Json& json, const char* key) {
    return json.is_object() && json.contains(key) ? json[key] : Json(nullptr);
}

} // namespace

std::filesystem::path source_beside(const MapFile& file) {
    if (file.name == "-") return {};
    return source_in(std::filesystem::path(file.name).parent_path(), file);
}

std::filesystem::path source_in(const std::filesystem::path& folder, const MapFile& file) {
    const Json name = member(member(parse_metadata(file.map()), "source"), "name");
    if (!name.is_string()) return {};
    // A name with a folder in it could point anywhere; the system ends one at a zero.
    const std::filesystem::path plain = name.get<std::string>();
    if (plain.empty() || plain.filename() != plain || plain.string().find('\0') != std::string::npos)
        return {};
    std::filesystem::path path = folder / plain;
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored) ? path : std::filesystem::path{};
}

std::optional<std::uint32_t> source_node(const MapFile& file) {
    const Json node = member(member(parse_metadata(file.map()), "options"), "node");
    if (!node.is_number_unsigned() || node.get<std::uint64_t>() >= no_index) return {};
    return node.get<std::uint32_t>();
}

std::optional<std::vector<std::string>> differing_files(const MapFile& file, const import::Report& source) {
    const Json files = member(member(parse_metadata(file.map()), "source"), "files");
    if (!files.is_array()) return {};
    std::vector<std::string> differing;
    for (std::size_t i = 0; i < source.files.size(); ++i) {
        const Json hash = i < files.size() ? member(files[i], "xxh3") : Json(nullptr);
        if (hash != hex64(source.files[i].xxh3)) differing.push_back(source.files[i].name);
    }
    return differing;
}

} // namespace spa::tools
