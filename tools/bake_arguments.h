// SPDX-License-Identifier: Apache-2.0
// The arguments of `spa bake`.
#pragma once

#include "bake_settings.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace spa::tools {

struct BakeArguments {
    std::filesystem::path input, output;
    std::optional<std::string> node; // --node as given; bake_file finds out which it is
    BakeSettings settings;
    bool make_folders = false; // those of the output that are missing; else they must be there
    bool follow_links = false;
    ReportFormat format = ReportFormat::text;
    bool quiet = false;
};

// Adds the options to the parser. The function returned is called after parsing and fills in what was not
// given. It throws Error{usage} where arguments contradict each other.
std::function<BakeArguments()> define_bake_arguments(CLI::App& app);

} // namespace spa::tools
