// SPDX-License-Identifier: Apache-2.0
#include "batch_page.h"

#include "page_data.h"

#include <nlohmann/json.hpp>
#include <page/batch_page_text.h>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

// Asset by asset, so that the text of all of them is never in memory at once.
void write_report(std::ostream& out, const Json& report) {
    out << "<script type=\"application/json\" id=\"report\">{";
    const char* comma = "";
    for (const auto& [key, value] : report.items()) {
        out << comma << "\n";
        write_script_json(out, key);
        out << ":";
        if (key == "assets") {
            const char* between = "[\n";
            for (const Json& asset : value) {
                out << between;
                write_script_json(out, asset);
                between = ",\n";
            }
            out << (value.empty() ? "[]" : "]");
        } else {
            write_script_json(out, value);
        }
        comma = ",";
    }
    out << "\n}</script>\n";
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
