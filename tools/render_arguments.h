// SPDX-License-Identifier: Apache-2.0
// The arguments of `spa render`.
#pragma once

#include "arguments.h"
#include "render_limits.h"

#include "../libspa/render/render.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spa::render {
const char* name(Geometry geometry);
const char* name(Backend backend);
} // namespace spa::render

namespace spa::tools {

// The most that --size may ask for.
constexpr std::uint32_t max_picture_pixels = 1U << 26U;

// How maps are traced. sphere: the paper's fan without test rays, which takes what lies straight below the
// point where the ray meets the sphere.
enum class MapMethod : std::uint8_t { projective, fan, march, sphere };
const char* name(MapMethod method);

// The most that --frames may ask for.
constexpr std::uint32_t max_frames = 64;

// [NODE=]FILE.spa
struct MapArgument {
    std::string node; // empty: the whole scene
    std::string file;
};

struct RenderArguments {
    std::filesystem::path scene, output;
    std::vector<MapArgument> maps;
    std::filesystem::path plan, plan_maps, plan_sheet; // empty: none, beside the plan, none
    bool has_samples = false; // --samples or --reference was given: the plan's do not count
    bool plan_only = false;   // without what it is compared with
    std::uint32_t layers = 0; // of the maps; 0: all
    std::optional<std::string> camera, animation;
    std::optional<double> time; // seconds
    std::uint32_t frames = 0;   // pictures of a sheet; 0: one picture, not a sheet
    // Without the camera, which the scene decides.
    render::Settings settings;
    MapMethod method = MapMethod::projective;
    bool by_distance = false; // test rays by the ray's distance from the centre
    bool reference = false;
    double exposure = 0; // stops
    bool aovs = false;
    std::filesystem::path compare, difference; // empty: none
    std::vector<ImageLimit> fail;
    std::string device;
    bool list_devices = false;
    ReportFormat format = ReportFormat::text;
    bool follow_links = false;
    bool quiet = false;

    [[nodiscard]] bool writes_exr() const;
    // Whether the scene is drawn at a moment of an animation.
    [[nodiscard]] bool is_posed() const { return animation || time || frames != 0; }
    // Whether some kind of ray meets maps, and some meets the triangles that they replace.
    [[nodiscard]] bool uses_maps() const;
    [[nodiscard]] bool uses_replaced_triangles() const;
};

// Adds the options; what it returns gives the arguments once the parser is done. Throws Error{usage}.
std::function<RenderArguments()> define_render_arguments(CLI::App& app);

} // namespace spa::tools
