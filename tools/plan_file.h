// SPDX-License-Identifier: Apache-2.0
// PLAN.json, which `spa plan` writes, as those read it that follow it: `spa batch --from-plan` and
// `spa render --plan`. Schema: ../formats/schemas/plan.schema.json. Members that are not listed here are not
// looked at.
#pragma once

#include "batch_config.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

enum class PlanDecision : std::uint8_t { map, triangles, drop };
const char* name(PlanDecision decision);

struct PlanObject {
    std::uint32_t node = 0; // index into the nodes as import::read_scene lists them
    std::string name;       // of the node
    // The node of the object, earlier or later in the list, whose map is this one's too: an instance of the
    // same mesh.
    std::optional<std::uint32_t> same_as;
    PlanDecision decision = PlanDecision::triangles;
    GivenSettings settings;    // of its bake, checked
    std::string method;        // how its map is to be traced
    std::filesystem::path map; // where the map goes, relative to the plan's folder; empty if it has none
};

// A file that the scene was read from when it was planned.
struct PlanSource {
    std::string name; // relative to the scene's folder
    std::uint64_t bytes = 0;
    std::string xxh3; // 16 hexadecimal digits
};

struct Plan {
    std::filesystem::path path;
    std::filesystem::path scene; // as it is to be opened
    std::vector<PlanSource> files;
    std::optional<std::string> camera;    // that it was made for
    std::optional<std::uint32_t> samples; // the same: secondary rays of a primary hit
    std::uint32_t one_size = 0;           // --size of maps that are all of one size
    std::vector<PlanObject> objects;
    std::map<std::uint32_t, std::size_t> by_node; // indices into objects

    // The object whose map the object has, itself where it has its own.
    [[nodiscard]] const PlanObject& owner_of_map(const PlanObject& object) const;
};

// Reads and checks a plan, which anybody may have written: types and ranges, that no node comes twice, that
// every map has settings which a bake takes, and that maps are written below the folder that they are meant
// for (relative paths without "..", ending with .spa, none twice). Throws Error: input_output if the file
// cannot be read, invalid_data if it is not as described; the message names file and place (JSON pointer).
Plan read_plan(const std::filesystem::path& path);

// What the plan was made from is another file now: a sentence for each such file. Reads the files; a name
// that leads out of the scene's folder is not followed.
std::vector<std::string> changed_sources(const Plan& plan, const std::filesystem::path& scene);

// The folder of the plan of this path: its maps lie there unless they were sent elsewhere.
std::filesystem::path folder_of_plan(const std::filesystem::path& plan);

// Where the map of an object that has its own is, below `folder`. Throws Error{invalid_data} if a symbolic
// link leads out of the folder, unless follow_links.
std::filesystem::path map_path(const Plan& plan, const PlanObject& object,
                               const std::filesystem::path& folder, bool follow_links);

} // namespace spa::tools
