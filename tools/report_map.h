// SPDX-License-Identifier: Apache-2.0
// What a report says about one .spa file.
#pragma once

#include "json_pick.h"
#include "report_files.h"
#include "report_page.h"

#include "../libspa/core/error.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace spa::tools {

struct MapReportOptions {
    std::filesystem::path source_folder; // where sources are looked for besides beside the maps; may be empty
    std::uint32_t rays = 16384;          // to time, and to judge maps without figures; 0: neither
    bool follow_links = false;           // import.h, Limits::follow_links
    bool pictures = true;
    bool sheets = true; // with pictures
};

struct MapReport {   // NOLINT(bugprone-exception-escape): of moving a Json, which is noexcept
    PickedJson json; // an entry of `maps` in formats/schemas/report.schema.json
    MapPictures pictures;
    std::optional<ExitCode> failure; // the file could not be read; json["error"] says why
};

// Reads the file, times it and, where its source is found and is the one that it was baked from, the source's
// triangles; measures what rays meet in both if the file has no figures of its own. Throws bake::Cancelled if
// `go_on` says no; all else that goes wrong is in the result.
MapReport report_map(const ReportFile& file, const MapReportOptions& options,
                     const std::function<bool()>& go_on);

} // namespace spa::tools
