// SPDX-License-Identifier: Apache-2.0
// Lines of comma-separated values (RFC 4180).
#pragma once

#include <cstdint>
#include <string>

namespace spa::tools {

// Appends a field to a line without its end; text is quoted where a comma, a quote or a line break asks for
// it, numbers have six significant digits.
void append_field(std::string& line, const std::string& text);
void append_field(std::string& line, std::uint64_t number);
void append_field(std::string& line, double number);

} // namespace spa::tools
