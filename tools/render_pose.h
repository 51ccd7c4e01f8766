// SPDX-License-Identifier: Apache-2.0
// A moment of an animation of the scene that `spa render` draws.
#pragma once

#include "render_input.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace spa::tools {

// The animation of that name, or of that number; the first without an argument. Throws Error{usage} if there
// is none such.
std::size_t choose_animation(const Scene& scene, const RenderArguments& arguments);

// Times of `count` pictures evenly over the animation; its end, which is often its beginning, is not among
// them.
std::vector<double> frame_times(const Animation& animation, std::uint32_t count);

// The scene as it stands at this time: nodes and vertices. Cameras and lights stay. scene.rig is not empty.
void pose_scene(Scene& scene, std::size_t animation, double time);

// For the renderer; refers to `maps`. dropped: nodes in whose place is nothing. Parts that follow nodes stand
// where those do if the scene is posed; NODE then says what is replaced alone. Throws Error as pose_parts,
// with the map's name.
std::vector<render::MapPlacement> placements(const Scene& scene, const std::vector<PlacedMap>& maps,
                                             const std::vector<std::uint32_t>& dropped,
                                             const RenderArguments& arguments);

// A camera that sees all of the scene at all of these times, as framing_camera.
Camera framing_camera(const Scene& scene, std::size_t animation, const std::vector<double>& times,
                      double aspect);

} // namespace spa::tools
