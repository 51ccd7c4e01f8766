// SPDX-License-Identifier: Apache-2.0
// A scene at one moment of an animation.
#pragma once

#include "scene.h"

#include <vector>

namespace spa {

// Where every node stands, one entry a node: SceneNode::to_world of this moment. time: seconds, before the
// first and after the last key of a curve its first and last value (glTF 2.0, 3.11). O(nodes + log keys).
std::vector<Affine> pose_nodes(const Scene& scene, const Animation& animation, double time);

// The model's positions and normals with the nodes at `to_world`: linear blend skinning,
// p = sum of weight * to_world[node] * inverse_bind * rig position; normals by the inverse transpose of that
// sum, unit length. scene.rig is not empty. O(vertices), parallel in the caller's arena.
void pose_vertices(const Scene& scene, const std::vector<Affine>& to_world, Model& model);

} // namespace spa
