// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#include "../../libspa/core/error.h"
#include "source_file.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace spa::import {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

bool is_control(char c) { return (c >= 0 && c < 32) || c == 127; }

char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

} // namespace

std::string_view as_text(std::span<const std::byte> bytes) {
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return text;
}

std::optional<std::string_view> LineReader::read() {
    if (next >= text.size()) return std::nullopt;
    const std::size_t begin = next;
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    next = end + 1;
    if (end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n') ++next;
    ++line;
    return text.substr(begin, end - begin);
}

std::string_view TokenReader::read() {
    for (;;) {
        const std::string_view token = cut_token(rest);
        if (!token.empty()) return token;
        const auto line = lines.read();
        if (!line) return {};
        rest = *line;
    }
}

std::string_view cut_token(std::string_view& rest) {
    std::size_t begin = 0;
    while (begin < rest.size() && is_blank(rest[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest.size() && !is_blank(rest[end])) ++end;
    const std::string_view token = rest.substr(begin, end - begin);
    rest.remove_prefix(end);
    return token;
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && (is_blank(text.front()) || is_control(text.front()))) text.remove_prefix(1);
    while (!text.empty() && (is_blank(text.back()) || is_control(text.back()))) text.remove_suffix(1);
    return text;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

std::optional<float> parse_float(std::string_view token) {
    // std::from_chars reads no leading '+'.
    if (token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+') token.remove_prefix(1);
    const char* const end = token.data() + token.size();
    float value = 0;
    const auto [stop, status] = std::from_chars(token.data(), end, value);
    if (status == std::errc::invalid_argument) return std::nullopt;
    const bool negative = token.front() == '-';
    const float infinity = std::numeric_limits<float>::infinity();
    if (stop != end) {
        const std::string_view rest(stop, std::size_t(end - stop));
        if (rest.starts_with("#INF")) return negative ? -infinity : infinity;
        if (rest.starts_with("#IND") || rest.starts_with("#QNAN") || rest.starts_with("#SNAN"))
            return std::numeric_limits<float>::quiet_NaN();
        return std::nullopt;
    }
    if (status == std::errc::result_out_of_range) {
        const std::string_view digits = token.substr(negative ? 1 : 0);
        const bool tiny = digits.find("e-") != std::string_view::npos ||
                          digits.find("E-") != std::string_view::npos || digits.front() == '0' ||
                          digits.front() == '.';
        if (tiny) return 0.0F;
        return negative ? -infinity : infinity;
    }
    return value;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
    if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
    std::int64_t value = 0;
    const char* const end = token.data() + token.size();
    const auto [stop, status] = std::from_chars(token.data(), end, value);
    if (status != std::errc{} || stop != end) return std::nullopt;
    return value;
}

std::string quote(std::string_view text) {
    constexpr std::size_t longest = 60;
    const bool cut = text.size() > longest;
    std::string result = "'" + std::string(text.substr(0, longest)) + (cut ? "...'" : "'");
    std::replace_if(result.begin(), result.end(), is_control, '?');
    return result;
}

std::string shorten(std::string message) {
    constexpr std::size_t longest = 1000;
    if (message.size() <= longest) return message;
    message.resize(longest);
    while (!message.empty() && (static_cast<unsigned char>(message.back()) & 0xC0U) == 0x80)
        message.pop_back();
    if (!message.empty() && static_cast<unsigned char>(message.back()) >= 0xC0) message.pop_back();
    return message + "...";
}

void fail(const std::filesystem::path& path, const std::string& what) {
    throw Error(ExitCode::invalid_data, path.string() + ": " + what);
}

void fail(const std::filesystem::path& path, std::size_t line, const std::string& what) {
    fail(path, "line " + std::to_string(line) + ": " + what);
}

void warn(Report& report, std::string warning) {
    constexpr std::size_t most = 100;
    if (report.warnings.size() < most)
        add_warning(report, std::move(warning));
    else if (report.warnings.size() == most)
        add_warning(report, "There are more warnings than are listed here.");
}

} // namespace spa::import
