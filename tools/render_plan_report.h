// SPDX-License-Identifier: Apache-2.0
// What `spa render --plan` says beyond other renderings: "plan" of ../formats/schemas/render.schema.json.
#pragma once

#include "picture.h"
#include "render_plan.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace spa::tools {

// What rays need of a scene's memory on the device. By default secondary and shadow rays meet maps, and rays
// from the camera meet triangles; what maps replace stays for these.
struct NeededMemory {
    std::uint64_t by_map_rays = 0;      // triangles that nothing replaces, maps, and structures of both
    std::uint64_t by_triangle_rays = 0; // all triangles and their structures
    std::uint64_t resident = 0;         // all there is
};
NeededMemory needed_memory(const render::SceneMemory& memory);

nlohmann::ordered_json plan_json(const PlanFacts& facts);
// Pictures, indirect light, and where that differs from triangles alone: triangles, one size and plan side by
// side. Not for --plan-only.
Picture plan_sheet(const PlanFacts& facts, std::uint32_t width, std::uint32_t height, double exposure);
// A table for people; label_width: of the report's first column.
std::string plan_text(const PlanFacts& facts, std::size_t label_width);

} // namespace spa::tools
