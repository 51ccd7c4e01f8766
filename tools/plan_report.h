// SPDX-License-Identifier: Apache-2.0
// A plan as a file (formats/schemas/plan.schema.json), and what `spa plan` says of it on standard output
// (formats/schemas/plan-report.schema.json).
#pragma once

#include "plan_arguments.h"

#include "../formats/import/import.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spa::tools {

struct ScenePlanFacts {
    const PlanArguments& arguments;
    const import::Report& source;
    std::uint64_t triangles = 0; // of the scene
    const plan::ScenePlan& plan;
};

// The same for the same scene and arguments.
nlohmann::ordered_json scene_plan_json(const ScenePlanFacts& facts);

nlohmann::ordered_json plan_report_json(const ScenePlanFacts& facts);
// A table, largest first, and the sums.
std::string plan_report_text(const ScenePlanFacts& facts);

} // namespace spa::tools
