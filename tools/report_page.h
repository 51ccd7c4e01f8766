// SPDX-License-Identifier: Apache-2.0
// The report of many maps as one page for a browser: speed against error, a table, and what was decided and
// why. It holds all it shows, the library that draws the plots too (page/page.cmake), asks no network for
// anything and runs no script but its own, whatever the names and messages in the report.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <ostream>
#include <span>
#include <vector>

namespace spa::tools {

// PNG files; empty: there is none.
struct MapPictures {
    std::vector<std::byte> thumbnail, sheet;
};

// report: as formats/schemas/report.schema.json says; strings may hold any bytes, and those that are not
// UTF-8 are shown as U+FFFD. pictures: one entry a map, or none at all. Whether all was written is for the
// caller to ask `out`.
void write_report_page(std::ostream& out, const nlohmann::ordered_json& report,
                       std::span<const MapPictures> pictures);

} // namespace spa::tools
