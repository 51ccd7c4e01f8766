// SPDX-License-Identifier: Apache-2.0
// What decides the bytes of a map: the options that `spa bake` and `spa batch` share, from the command line
// to bake::Options, and to the JSON that goes into files and reports.
#pragma once

#include "arguments.h"
#include "search_settings.h"
#include "source_asset.h"

#include "../libspa/bake/bake_options.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace spa::tools {

struct BakeSettings {
    bake::Options options{.frame = bake::Frame::automatic, .center = bake::Center::automatic};
    PartsKind parts = PartsKind::whole;
    std::uint32_t max_parts = default_max_parts;
    bool compress = true; // zstd
    bool measure = false;

    [[nodiscard]] Division division() const { return {parts, max_parts, options.layers}; }
    std::optional<plan::SearchRequest> search; // what of `options` a target decides
    // Of the asset only what this node draws, in its space: an index into the nodes as import::read_scene
    // lists them. No option of define_bake_settings: it means something for one asset alone.
    std::optional<std::uint32_t> node;
};

// Adds the options to the parser. The function returned is called after parsing and fills in what was not
// given. It throws Error{usage} where options contradict each other.
std::function<BakeSettings()> define_bake_settings(CLI::App& app);

// Every option that the bytes of the output depend on, effective value, under the name that it has on the
// command line and as text or number that the command line takes.
nlohmann::ordered_json options_json(const BakeSettings& settings);
// The same as it was asked for: with a search its target instead of what it decides. Without one the same.
nlohmann::ordered_json request_json(const BakeSettings& settings);

// The size of a map as --size takes it: "256" (octahedral, cells a side) or "640x480".
std::string size_text(const Grid& grid);

} // namespace spa::tools

namespace spa::bake {
const char* name(Frame frame);
const char* name(Center center);
const char* name(Baker baker);
const char* name(GlApi gl);
} // namespace spa::bake
