// SPDX-License-Identifier: Apache-2.0
// What `spa render` draws: the scene, and what its arguments choose in it.
#pragma once

#include "map_file.h"
#include "render_arguments.h"

#include "../formats/import/import.h"

#include <string>
#include <vector>

namespace spa::tools {

// One --map: its file and the nodes that it takes the place of, indices into Scene::nodes; no_index: all.
struct PlacedMap {
    std::string node; // empty: the whole scene
    MapFile file;
    std::vector<std::uint32_t> nodes;

    [[nodiscard]] bool replaces_scene() const { return !nodes.empty() && nodes.front() == no_index; }
};

// Nodes of that name, without those below another of them: replacing a node replaces all below it. Throws
// Error{usage} if there is none; the message says what name may have been meant. O(nodes * depth).
std::vector<std::uint32_t> find_nodes(const Scene& scene, const std::string& scene_name,
                                      const std::string& node);

// Where each map goes. Throws Error: as find_nodes; usage if one map's node lies below another's; as
// open_map.
std::vector<PlacedMap> place_maps(const Scene& scene, const RenderArguments& arguments);

// A sentence for each map that can hardly be one of the node it takes the place of: its spheres lie
// elsewhere, or are of another size, than the node's triangles in the node's own space. Not of maps without
// NODE and, if the scene is going to be posed, with parts that follow nodes. O(triangles * maps).
std::vector<std::string> misfits(const Scene& scene, const std::vector<PlacedMap>& maps, bool is_posed);

// Whether `node` lies below `above`. O(depth).
bool is_below(const Scene& scene, std::uint32_t node, std::uint32_t above);

// A map, or nothing (null), in the place of a node, as the arguments have maps traced.
render::MapPlacement placement(std::uint32_t node, const SphericalMap* map, const RenderArguments& arguments);

// The scene's camera of that name, or of that number; the first without an argument, and where there is none
// one that shows the whole scene. Throws Error{usage} if there is none such.
Camera choose_camera(const Scene& scene, const RenderArguments& arguments);
// The scene's camera of that name, or of that number. Throws as choose_camera.
const Camera& find_camera(const Scene& scene, const std::filesystem::path& scene_path,
                          const std::string& camera);

// A camera that sees all of the model, from the front, the right and above. aspect: width / height.
Camera framing_camera(const Model& model, double aspect);
// `count` like it, evenly around the scene, that one first.
std::vector<Camera> surrounding_cameras(const Model& model, double aspect, std::uint32_t count);

// A sun behind the camera, above its left shoulder, under which a white surface that faces it has radiance 1.
Light default_sun(const Camera& camera);

// A third as strong, from the other side, so that nothing that moves goes dark.
Light default_fill(const Camera& camera);

} // namespace spa::tools
