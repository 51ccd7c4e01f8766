// SPDX-License-Identifier: Apache-2.0
#include "map_file.h"

#include "../libspa/core/error.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace spa::tools {

namespace {

container::Status read_standard_input(container::File& file) {
    const container::ReadExactly read_exactly = [](std::span<std::byte> out) {
        return std::fread(out.data(), 1, out.size(), stdin) == out.size();
    };
    container::Status status = container::read(read_exactly, file);
    // The reader stops at the end that the file itself states.
    if (status.ok() && std::fgetc(stdin) != EOF) {
        status.issue = container::Issue::file_too_long;
        status.offset = file.length();
    }
    return status;
}

} // namespace

void require(const container::Status& status, const std::string& file_name) {
    if (!status.ok()) throw Error(container::exit_code(status.issue), container::describe(status, file_name));
}

MapFile open_map(const std::string& path) {
    MapFile result{path, {}};
    if (path == "-")
        require(read_standard_input(result.file), "standard input");
    else
        require(container::open(path, result.file), path);
    return result;
}

nlohmann::ordered_json parse_metadata(const SphericalMap& map) {
    if (map.metadata.empty()) return nullptr;
    // What the container's check lets pass and JSON for C++ does not hold (1e999, half a surrogate pair) is
    // as good as none.
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(map.metadata, nullptr, false);
    return json.is_discarded() ? nlohmann::ordered_json(nullptr) : json;
}

} // namespace spa::tools
