// SPDX-License-Identifier: Apache-2.0
// `spa render --frames`: an animation as a sheet of pictures, maps below the skinned triangles.
#pragma once

#include "render_compare.h"
#include "render_pose.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace spa::tools {

struct AnimationFrame {
    double time = 0;            // seconds
    double pose_seconds = 0;    // to move the maps on the device: instances and top level
    ImageComparison comparison; // of the picture with maps with that of triangles alone
    // Whether a ray of the camera meets something, a pixel: with triangles, with maps.
    std::vector<bool> triangles_seen, maps_seen;
};

// Renders the scene `times.size()` times. `scene` is posed and left at the last time. frame_times: their sum,
// of the pictures with maps. progress: share done; false ends it, with fewer frames. Throws Error as
// placements and render.
std::vector<AnimationFrame> render_frames(const RenderArguments& arguments, const render::Gpu& gpu,
                                          Scene& scene, const std::vector<PlacedMap>& maps,
                                          const render::Settings& settings, std::size_t animation,
                                          const std::vector<double>& times, render::DeviceScene& device_scene,
                                          render::FrameTimes& frame_times,
                                          const std::function<bool(double)>& progress);

Picture frames_sheet(const std::vector<AnimationFrame>& frames, const std::string& title);

nlohmann::ordered_json frames_json(const std::vector<AnimationFrame>& frames);
// Lines for people; label_width: of the report's first column.
std::string frames_text(const std::vector<AnimationFrame>& frames, std::size_t label_width);

} // namespace spa::tools
