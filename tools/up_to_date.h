// SPDX-License-Identifier: Apache-2.0
// Whether a map is what a bake would make now. The answer is in the map itself: the key in its metadata
// (bake_key.h). So that not every source has to be read to find out, the state of the sources on disk (size,
// times, inode) at which they had the content of that key is remembered in an extended attribute of the map's
// file, "user.spa.sources"; where the file system has none, or the state is another, the content decides.
#pragma once

#include "bake_settings.h"

#include "../formats/import/import.h"

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>

namespace spa::tools {

// Why a map is to be baked.
enum class BakeReason : std::uint8_t {
    none,
    first,   // there is no map
    sources, // a file that it was made from is another, or gone; or one that was missing is there
    options,
    version, // of the baker
    damaged, // it cannot be read, or its metadata do not say what it was made from
    forced,
};
const char* name(BakeReason reason); // BakeReason::none: ""

enum class Freshness : std::uint8_t {
    current,
    stale,
    unknown, // more than `read_at_most` bytes would have to be read
};

// What the metadata of a map say about it, for reports.
struct MapFacts {
    std::uint64_t source_bytes = 0, triangles = 0, bytes = 0;
    std::string options; // JSON, effective values; empty: not known
    std::string figures; // JSON; empty if it was not measured
};

struct MapState {
    Freshness freshness = Freshness::stale;
    BakeReason reason = BakeReason::none; // where it is stale
    MapFacts facts;                       // where it is current
};

// Compares the map in `output` with the asset in `path` and these settings. Touches no image; reads sources
// only where their state is not the remembered one, and then at most so many bytes. A map that proves current
// by content gets its attribute anew. Never throws for what is on disk.
MapState judge_map(const std::filesystem::path& output, const std::filesystem::path& path,
                   const BakeSettings& settings, std::uint64_t read_at_most);

// Remembers the states that the sources of a map just baked had when they were read. `started`: when reading
// began. Does nothing where a source changed so shortly before that a later change could look the same, and
// where the file system has no extended attributes.
void remember_sources(const std::filesystem::path& output, const import::Report& report,
                      const std::string& key, std::timespec started);

} // namespace spa::tools
