// SPDX-License-Identifier: Apache-2.0
#include "csv.h"

#include "text.h"

namespace spa::tools {

namespace {

std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

} // namespace

void append_field(std::string& line, const std::string& text) {
    line += (line.empty() ? "" : ",") + field(text);
}
void append_field(std::string& line, std::uint64_t number) { append_field(line, std::to_string(number)); }
void append_field(std::string& line, double number) { append_field(line, significant(number, 6)); }

} // namespace spa::tools
