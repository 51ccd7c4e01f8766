// SPDX-License-Identifier: Apache-2.0
// The arguments of `spa plan`.
#pragma once

#include "arguments.h"

#include "../libspa/plan/scene_plan.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace spa::tools {

struct PlanArguments {
    std::filesystem::path scene, output, html; // html: empty: none
    std::optional<std::string> camera;         // name
    std::optional<std::uint32_t> views;        // cameras around the scene instead
    plan::PlanOptions options;
    ReportFormat format = ReportFormat::text;
    bool follow_links = false;
    bool quiet = false;
};

// Adds the options; what it returns gives the arguments once the parser is done. Throws Error{usage}.
std::function<PlanArguments()> define_plan_arguments(CLI::App& app);

} // namespace spa::tools
