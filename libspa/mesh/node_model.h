// SPDX-License-Identifier: Apache-2.0
// One object of a scene as a model of its own.
#pragma once

#include "scene.h"

#include <cstdint>
#include <vector>

namespace spa {

// Which nodes are `node` or below it, one entry a node of the scene. O(nodes).
std::vector<bool> nodes_below(const Scene& scene, std::uint32_t node);

// What the node and the nodes below it draw, in the node's local space: the model whose map can take the
// node's place. Triangles and vertices keep their order; vertices, materials and textures are those that
// these triangles use. A mirrored transform turns the winding over, as the import did, so that front faces
// are front faces again. Positions went to the world and back in single precision: they are exact to some
// 1e-7 of their distance from the world's origin.
//
// Throws Error{invalid_data} if the node's transform has no inverse, or if no triangle is drawn there; the
// message begins with the node. O(vertices + triangles + nodes).
Model node_model(const Scene& scene, std::uint32_t node);

// "node 12 'boot'", or "node 12" where it has no name: how messages call it.
std::string node_text(const Scene& scene, std::uint32_t node);

} // namespace spa
