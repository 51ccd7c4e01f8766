// SPDX-License-Identifier: Apache-2.0
// A scene of a few objects whose transforms are of every kind.
#pragma once

#include "../../libspa/mesh/scene.h"

#include <cstdint>
#include <string>

namespace spa::test {

// Appends a node whose local mesh is `mesh`, as an importer would: in world space, turned over where
// to_world mirrors. Returns the node.
std::uint32_t add_object(Scene& scene, const std::string& name, const Model& mesh, const Affine& to_world,
                         std::uint32_t parent = no_index);

// Nodes: 0 "floor", a square of 8 by 8; 1 "ball", moved and turned; 2 "twin", the same mesh mirrored, sheared
// and elsewhere; 3 "stand", which draws nothing; 4 "crate", below it, a box; 5 "crumb", a tiny box. A camera
// and a light.
Scene object_scene();

} // namespace spa::test
