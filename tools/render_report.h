// SPDX-License-Identifier: Apache-2.0
// What `spa render` says on standard output.
// Schemas: ../formats/schemas/render.schema.json, render-devices.schema.json.
#pragma once

#include "render_frames.h"
#include "render_plan.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spa::tools {

struct WrittenFile {
    std::string path;
    std::uint64_t bytes;
};

// Everything that a report is made from. The references outlive it.
struct RenderFacts {
    const RenderArguments& arguments;
    const render::Settings& settings;
    const Scene& scene;
    const std::vector<PlacedMap>& maps; // the plan's, if there is one
    const render::DeviceEntry& device;
    render::SceneMemory memory{};
    render::SceneTimes scene_times{};
    render::FrameTimes frame_times{};
    double read_seconds = 0; // scene and maps
    double seconds = 0;      // all
    std::optional<ImageComparison> comparison{};
    std::optional<PlanFacts> plan{};
    std::optional<std::size_t> animation{}; // index into the rig's
    std::vector<AnimationFrame> frames{};   // of --frames
    std::vector<WrittenFile> files{};
};

nlohmann::ordered_json report_json(const RenderFacts& facts);
std::string report_text(const RenderFacts& facts);

nlohmann::ordered_json devices_json(std::span<const render::DeviceEntry> devices);
std::string devices_text(std::span<const render::DeviceEntry> devices);

} // namespace spa::tools
