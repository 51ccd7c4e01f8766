// SPDX-License-Identifier: Apache-2.0
// Numbers and paragraphs as text for people.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spa::tools {

// Fixed-point, '.' whatever the locale; "nan" and "inf" as such.
std::string fixed(double value, int decimals);
// `digits` significant digits, as short as that allows: "0.0001234", "1.2e-07", "90".
std::string significant(double value, int digits);
// 0.1234 -> "12.3 %".
std::string percent(double share, int decimals = 1);
// "512 bytes", "41.2 KiB", "1.3 MiB", "2.0 GiB".
std::string byte_count(std::uint64_t bytes);
// 16 lower-case hexadecimal digits.
std::string hex64(std::uint64_t value);
// Two lower-case digits a byte.
std::string hexadecimal(std::string_view bytes);
// Digits alone, of a number that fits; nothing for any other text.
std::optional<std::size_t> whole_number(std::string_view text);
std::string pad_left(std::string text, std::size_t width);
std::string pad_right(std::string text, std::size_t width);
// Breaks at spaces so that no line is longer than `width` (words longer than that stand alone). Empty lines
// divide paragraphs and stay.
std::vector<std::string> wrap_text(std::string_view text, std::size_t width);

} // namespace spa::tools
