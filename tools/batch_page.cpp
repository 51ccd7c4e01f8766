// SPDX-License-Identifier: Apache-2.0
#include "batch_page.h"

#include <nlohmann/json.hpp>
#include <page/batch_page_text.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

// JSON inside of <script>: outside of strings it has no '<', and inside of them "<" is the same character. So
// neither "</script" nor "<!--" can appear.
void write_json(std::ostream& out, const Json& value) {
    const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::size_t begin = 0;
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', begin)) {
        out << std::string_view(text).substr(begin, at - begin) << "\\u003c";
        begin = at + 1;
    }
    out << std::string_view(text).substr(begin);
}

// Asset by asset, so that the text of all of them is never in memory at once.
void write_report(std::ostream& out, const Json& report) {
    out << "<script type=\"application/json\" id=\"report\">{";
    const char* comma = "";
    for (const auto& [key, value] : report.items()) {
        out << comma << "\n";
        write_json(out, key);
        out << ":";
        if (key == "assets") {
            const char* between = "[\n";
            for (const Json& asset : value) {
                out << between;
                write_json(out, asset);
                between = ",\n";
            }
            out << (value.empty() ? "[]" : "]");
        } else {
            write_json(out, value);
        }
        comma = ",";
    }
    out << "\n}</script>\n";
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8U | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? alphabet[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

} // namespace

void write_batch_page(std::ostream& out, const Json& report, const ThumbnailSource& thumbnail) {
    out << batch_page_begin;
    write_report(out, report);
    const std::size_t count = report.at("assets").size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<std::byte> png = thumbnail(i);
        if (png.empty()) continue;
        out << "<script type=\"text/plain\" id=\"thumbnail-" << i << "\">" << base64(png) << "</script>\n";
    }
    out << batch_page_end;
}

} // namespace spa::tools
