// SPDX-License-Identifier: Apache-2.0
// A `.spa` file opened for a verb: checked in full, and anything wrong turned into an Error.
#pragma once

#include "../formats/container/reader.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spa::tools {

struct MapFile {
    std::string name; // as given
    container::File file;

    [[nodiscard]] const SphericalMap& map() const { return file.map(); }
};

// path: "-" reads standard input as a stream. Throws Error with the checker's sentence.
MapFile open_map(const std::string& path);

// Throws Error if `status` is not ok.
void require(const container::Status& status, const std::string& file_name);

// null if there is none, or none that can be used.
nlohmann::ordered_json parse_metadata(const SphericalMap& map);

} // namespace spa::tools
