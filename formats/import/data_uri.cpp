// SPDX-License-Identifier: Apache-2.0
#include "data_uri.h"

#include "source_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace spa::import {
namespace {

constexpr std::uint8_t not_base64 = 0xFF;

constexpr std::array<std::uint8_t, 256> base64_values = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(not_base64);
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i)
        values[static_cast<unsigned char>(alphabet[i])] = static_cast<std::uint8_t>(i);
    return values;
}();

std::uint32_t value_of(char c) { return base64_values[static_cast<unsigned char>(c)]; }

} // namespace

std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
    const std::size_t rest = text.size() % 4; // characters of the last, partial group
    if (rest == 1) return std::nullopt;
    std::vector<std::byte> out(text.size() / 4 * 3 + (rest == 0 ? 0 : rest - 1));
    std::byte* to = out.data();
    const char* from = text.data();
    std::uint32_t seen = 0; // 6-bit values leave the upper bits clear; not_base64 sets them
    for (std::size_t group = text.size() / 4; group > 0; --group, from += 4, to += 3) {
        const std::uint32_t a = value_of(from[0]), b = value_of(from[1]), c = value_of(from[2]),
                            d = value_of(from[3]);
        seen |= a | b | c | d;
        const std::uint32_t bits = a << 18U | b << 12U | c << 6U | d;
        to[0] = static_cast<std::byte>(bits >> 16U & 0xFFU);
        to[1] = static_cast<std::byte>(bits >> 8U & 0xFFU);
        to[2] = static_cast<std::byte>(bits & 0xFFU);
    }
    if (rest > 0) {
        const std::uint32_t a = value_of(from[0]), b = value_of(from[1]),
                            c = rest == 3 ? value_of(from[2]) : 0;
        seen |= a | b | c;
        const std::uint32_t bits = a << 18U | b << 12U | c << 6U;
        to[0] = static_cast<std::byte>(bits >> 16U & 0xFFU);
        if (rest == 3) to[1] = static_cast<std::byte>(bits >> 8U & 0xFFU);
    }
    if (seen > 63) return std::nullopt;
    return out;
}

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!is_data_uri(uri) || comma == std::string_view::npos) return std::nullopt;
    const std::string_view head = uri.substr(5, comma - 5), content = uri.substr(comma + 1);
    constexpr std::string_view base64 = ";base64";
    if (head.size() >= base64.size() && head.substr(head.size() - base64.size()) == base64)
        return decode_base64(content);
    const std::string decoded = percent_decode(content);
    std::vector<std::byte> out(decoded.size());
    std::transform(decoded.begin(), decoded.end(), out.begin(),
                   [](char c) { return static_cast<std::byte>(c); });
    return out;
}

} // namespace spa::import
