// SPDX-License-Identifier: Apache-2.0
// From an asset on disk to a .spa on disk: what `spa bake` does once and `spa batch` for every asset.
#pragma once

#include "bake_report.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace spa::tools {

struct BakedFile {
    SourceAsset source;
    std::vector<bake::Report> part_reports;
    bake::Report report;                             // their sum
    std::vector<Part> parts;                         // without their images
    std::optional<measure::Measurement> measurement; // if settings.measure
    std::vector<std::byte> bytes;                    // of the file
    double seconds = 0;                              // reading and writing included

    // For the reports; refers to *this and to the arguments that it was baked with.
    [[nodiscard]] BakeFacts facts(const BakeArguments& arguments) const;
};

// Reads, bakes, measures if asked to, and writes the map whole or not at all. Shows progress on stderr unless
// arguments.quiet. Throws Error as read_model (import.h), bake_model (bake.h) and StagedFile (output.h) do,
// with messages that begin with a path, and bake::Cancelled after SIGINT, SIGTERM or SIGHUP.
BakedFile bake_file(const BakeArguments& arguments);

} // namespace spa::tools
