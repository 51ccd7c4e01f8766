// SPDX-License-Identifier: Apache-2.0
// RFC 2397 "data:" references.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace spa::import {

inline bool is_data_uri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

// The content of "data:[type][;parameters][;base64],content"; none if it is malformed.
std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);

// RFC 4648 base64, with or without padding; none for any other character.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

} // namespace spa::import
