// SPDX-License-Identifier: Apache-2.0
// What `spa validate` says. Schema of the JSON: ../formats/schemas/validate.schema.json.
#pragma once

#include "map_file.h"

#include "../libspa/measure/findings.h"
#include "../libspa/measure/measure_parts.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

// A threshold that the user set, judged.
struct Judged {
    std::string option;          // "--max-normal"
    double limit = 0, value = 0; // in the option's unit
    bool met = true;
    std::optional<measure::WorstTexel> at; // where a figure of texels is worst
    std::string sentence() const;          // what is wrong, for one that is not met
};

struct SourceFacts {
    std::filesystem::path path;
    // Files that are not those the map was baked from; none: the metadata does not say (map_source.h).
    std::optional<std::vector<std::string>> differing;
};

struct Validation {
    std::optional<SourceFacts> source;                    // none: the container check alone
    std::optional<measure::PartsMeasurement> measurement; // with a source
    std::vector<measure::Finding> findings;
    std::vector<Judged> thresholds;
};

// The figures of a measurement; also in the metadata of a map (`spa bake --measure`).
nlohmann::ordered_json figures_json(const measure::Measurement& measurement);

nlohmann::ordered_json validate_json(const MapFile& file, const Validation& validation);
std::string validate_text(const MapFile& file, const Validation& validation);

} // namespace spa::tools
