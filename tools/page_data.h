// SPDX-License-Identifier: Apache-2.0
// Data inside of pages for browsers.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <ostream>
#include <span>
#include <string>

namespace spa::tools {

// JSON inside of <script>: outside of strings it has no '<', and inside of them "\u003c" is the same
// character. So neither "</script" nor "<!--" can appear. Bytes that are not UTF-8 become U+FFFD.
void write_script_json(std::ostream& out, const nlohmann::ordered_json& value);

// RFC 4648.
std::string base64(std::span<const std::byte> bytes);

} // namespace spa::tools
