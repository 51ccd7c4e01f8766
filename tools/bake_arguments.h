// SPDX-License-Identifier: Apache-2.0
// The arguments of `spa bake`.
#pragma once

#include "bake_settings.h"

#include <filesystem>
#include <functional>
#include <string>

namespace spa::tools {

struct BakeArguments {
    std::filesystem::path input, output;
    BakeSettings settings;
    bool make_folders = false; // those of the output that are missing; else they must be there
    bool follow_links = false;
    ReportFormat format = ReportFormat::text;
    bool quiet = false;
};

// Adds the options to the parser. The function returned is called after parsing and fills in what was not
// given. It throws Error{usage} where arguments contradict each other.
std::function<BakeArguments()> define_bake_arguments(CLI::App& app);

// description: of the value 0 too. threads: its value is the default.
void add_threads(CLI::App& app, const std::string& description, unsigned& threads);

// Limits::follow_links (import.h) as an option.
void add_follow_links(CLI::App& app, bool& follow_links);

} // namespace spa::tools
