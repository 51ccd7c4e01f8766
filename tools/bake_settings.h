// SPDX-License-Identifier: Apache-2.0
// What decides the bytes of a map: the options that `spa bake` and `spa batch` share, from the command line
// to bake::Options, and to the JSON that goes into files and reports.
#pragma once

#include "arguments.h"

#include "../libspa/bake/bake_options.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>

namespace spa::tools {

struct BakeSettings {
    bake::Options options{.frame = bake::Frame::automatic, .center = bake::Center::automatic};
    bool compress = true; // zstd
    bool measure = false;
};

// Adds the options to the parser. The function returned is called after parsing and fills in what was not
// given. It throws Error{usage} where options contradict each other.
std::function<BakeSettings()> define_bake_settings(CLI::App& app);

// Every option that the bytes of the output depend on, effective value, under the name that it has on the
// command line and as text or number that the command line takes.
nlohmann::ordered_json options_json(const BakeSettings& settings);

// The size of a map as --size takes it: "256" (octahedral, cells a side) or "640x480".
std::string size_text(const Grid& grid);

} // namespace spa::tools

namespace spa::bake {
const char* name(Frame frame);
const char* name(Center center);
const char* name(Baker baker);
const char* name(GlApi gl);
} // namespace spa::bake
