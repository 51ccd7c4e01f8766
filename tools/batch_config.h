// SPDX-License-Identifier: Apache-2.0
// Options of a bake as they were given, for all assets or by pattern, and what follows for each asset.
#pragma once

#include "bake_settings.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace spa::tools {

// Options of define_bake_settings by name ("--size") with their text; "true" or "false" for a flag.
using GivenSettings = std::map<std::string, std::string>;

// The file of --config: JSON, ../formats/schemas/batch-config.schema.json.
//   {"options": {"size": 128},
//    "patterns": [{"match": "heroes/*", "options": {"size": 512, "measure": true}}]}
// The options' names are those of the command line without the dashes, or those in the metadata of a map.
struct BatchConfig {
    GivenSettings options;                                         // for all assets
    std::vector<std::pair<std::string, GivenSettings>> by_pattern; // the last that matches has the last word
};

// Throws Error: input_output if the file cannot be read, invalid_data if it is not as described or has an
// option or a value that there is not; the message names file and place.
BatchConfig read_batch_config(const std::filesystem::path& path);

// Options as in "options" of that file. where: file and place, which messages begin with. Throws
// Error{invalid_data}.
GivenSettings parse_given_settings(const nlohmann::json& json, const std::string& where);

// Those options of a parsed command line that define_bake_settings defined and that were given.
GivenSettings given_settings(const CLI::App& app);

// Throws Error{usage} where a value is wrong or options contradict each other.
BakeSettings parse_settings(const GivenSettings& given);

// The settings of each asset: the config's, overruled by the command line's.
class BatchSettings {
public:
    BatchSettings(BatchConfig config, GivenSettings command_line)
        : config_(std::move(config)), command_line_(std::move(command_line)) {}

    // Of the asset of this name; of what neither says `own` has the word, the settings that a plan gives the
    // asset. Parsed once for all assets that have the same; the reference lives as long as this. Throws
    // Error{usage} where they contradict each other; the message names the asset.
    const BakeSettings& of(const std::string& name, const GivenSettings& own = {});

private:
    BatchConfig config_;
    GivenSettings command_line_;
    std::map<GivenSettings, BakeSettings> parsed_;
};

} // namespace spa::tools
