// SPDX-License-Identifier: Apache-2.0
// `spa render --plan`: a scene as a plan has it, beside what it is compared with: triangles alone, and maps
// that are all of one size.
#pragma once

#include "plan_file.h"
#include "render_input.h"

#include "../formats/import/linear_picture.h"
#include "../libspa/measure/image_errors.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

// What a plan does to a scene.
struct PlacedPlan {
    Plan plan;
    std::vector<PlacedMap> maps;        // each once, with the nodes of all objects that have it
    std::vector<std::uint32_t> dropped; // nodes that only rays which meet triangles see
    std::uint64_t file_bytes = 0;       // of the maps
    std::uint64_t dropped_triangles = 0;
    std::uint64_t unique_triangles = 0; // of the scene, without those of instances of another object's mesh
};

// Opens the maps where `spa batch --from-plan` wrote them: below the plan's folder or arguments.plan_maps.
// Throws Error: invalid_data if the plan's nodes are not those of the scene, if one object's node lies below
// another's, or if a map is of another node; input_output if a map is missing; as map_path and open_map.
PlacedPlan place_plan(const Scene& scene, const RenderArguments& arguments, Plan plan);

// Sentences about what the plan and the arguments do not agree on.
std::vector<std::string> plan_warnings(const PlacedPlan& plan, const RenderArguments& arguments);

// One way to show the scene: the same picture by other means.
struct PlanVariant {
    std::vector<Vec3f> picture, indirect;             // linear; empty with --plan-only
    std::optional<measure::ImageErrors> to_triangles; // indirect light, against triangles alone
    std::optional<measure::ImageErrors> to_reference; // the same against the layer of --compare, if it has it
    render::FrameTimes times;
    render::SceneMemory memory;
    std::uint64_t file_bytes = 0; // of maps
    std::size_t maps = 0;         // that differ
};

struct PlanFacts {
    const PlacedPlan& placed;
    PlanVariant plan;
    std::optional<PlanVariant> triangles, one_size; // none with --plan-only
    std::vector<std::string> not_baked;             // for one size: sentences
    double bake_seconds = 0;
};

// What the comparison needs of the verb: renders with progress under this name.
using RenderVariant =
    std::function<render::Frame(const std::string& what, const render::DeviceScene& scene,
                                const render::Settings& settings, render::FrameTimes& times)>;

// Renders what the plan's frame is compared with, and fills in facts. frame: the plan's; settings: those that
// it was rendered with. Bakes the maps of one size in memory, with the options that `spa bake` has of itself.
// Throws Error, and bake::Cancelled after a signal.
void compare_plan(PlanFacts& facts, const RenderArguments& arguments, const render::Gpu& gpu,
                  const Scene& scene, const render::Settings& settings, const render::Frame& frame,
                  const import::LinearPicture* reference, const RenderVariant& draw);

} // namespace spa::tools
