// SPDX-License-Identifier: Apache-2.0
// A scene at one moment of an animation: where its nodes stand, and where that puts the vertices.
#pragma once

#include "../core/spherical_map.h"
#include "scene.h"

#include <vector>

namespace spa {

// Where every node stands, one entry a node: SceneNode::to_world of this moment. time: seconds; before the
// first and after the last key of a curve it rests at its first and last value (glTF 2.0, 3.11), and NaN is
// before all. Rotations are interpolated along the shorter way (appendix C.4), cubic splines as in C.5.
// O(nodes + tracks * log keys).
std::vector<Affine> pose_nodes(const Scene& scene, const Animation& animation, double time);

// The model's positions and normals with the nodes at `to_world`, one entry a node: linear blend skinning,
// p = sum of weight * to_world[node] * inverse_bind * rig position; normals by the inverse transpose of that
// sum, unit length; one that this leaves without direction stays as it is. scene.rig is not empty and `model`
// is scene.model or a copy of it: of the rig's vertices. Where a bone mirrors that did not mirror before, the
// triangles turn their backs: they stay as they are. O(vertices + influences), parallel in the caller's
// arena, the same for any number of threads.
void pose_vertices(const Scene& scene, const std::vector<Affine>& to_world, Model& model);

// Where the parts of a map stand with the nodes at `to_world`, one entry a part: from the map's object space
// to the world. A part that follows a node of the source (Part::node) stands at the node of that number
// (SceneNode::source) times Part::to_node; of nodes of one number it is the first at or below `node`, or else
// the first of all. The others stand at `otherwise`. node: index into Scene::nodes; no_index: all are below.
// Throws Error{usage} if a part follows a node that the scene has not. O(nodes * depth + parts).
std::vector<Affine> pose_parts(const Scene& scene, const std::vector<Affine>& to_world,
                               const SphericalMap& map, std::uint32_t node, const Affine& otherwise);

} // namespace spa
