// SPDX-License-Identifier: Apache-2.0
// Well-formedness of the metadata, without building anything from it. No allocation, no recursion.
#pragma once

#include <cstddef>
#include <string_view>

namespace spa::container {

constexpr std::size_t text_ok = std::string_view::npos;
constexpr std::size_t json_depth_limit = 64;

// The offset of the first byte that is not UTF-8 (RFC 3629: no surrogates, no overlong forms); text_ok if
// none.
std::size_t find_utf8_error(std::string_view text);

// The offset at which the text stops being one JSON object (RFC 8259) with white space around it, nested at
// most json_depth_limit deep; text_ok if it is one. Names need not be unique.
std::size_t find_json_error(std::string_view text);

} // namespace spa::container
