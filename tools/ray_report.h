// SPDX-License-Identifier: Apache-2.0
// The figures of rays (libspa/measure/map_rays.h) as text and JSON, for the reports that hold them.
#pragma once

#include "../libspa/measure/map_rays.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spa::tools {

nlohmann::ordered_json rays_json(const measure::RayFigures& figures);

// Several lines; label_width: of the report's first column.
std::string rays_text(const measure::RayFigures& figures, std::size_t label_width);

} // namespace spa::tools
