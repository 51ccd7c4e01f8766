// SPDX-License-Identifier: Apache-2.0
#include "report_page.h"

#include "page_data.h"

#include <nlohmann/json.hpp>
#include <page/report_page_text.h>

namespace spa::tools {

namespace {

void write_picture(std::ostream& out, const char* what, std::size_t map, std::span<const std::byte> png) {
    if (png.empty()) return;
    out << "<script type=\"text/plain\" id=\"" << what << '-' << map << "\">" << base64(png) << "</script>\n";
}

} // namespace

void write_report_page(std::ostream& out, const nlohmann::ordered_json& report,
                       std::span<const MapPictures> pictures) {
    out << report_page_begin;
    out << "<script type=\"application/json\" id=\"report\">";
    write_script_json(out, report);
    out << "</script>\n";
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        write_picture(out, "thumbnail", i, pictures[i].thumbnail);
        write_picture(out, "sheet", i, pictures[i].sheet);
    }
    out << report_page_end;
}

} // namespace spa::tools
