// SPDX-License-Identifier: Apache-2.0
// Small glTF scenes made on the spot, and how they are read.
#pragma once

#include "gltf_builder.h"

namespace spa::test {

using import::SceneResult;

// The triangle of gltf_builder.h under KHR_lights_punctual: node 0 draws it, node 1 has the light.
GltfBuilder lit_triangle(const Json& light);

// The same with a perspective camera instead of a light.
GltfBuilder seen_triangle(const Json& perspective);

// Reads a scene, written as a GLB and as glTF with a "data:" URI; both must be the same, and their models and
// reports those of read_model.
SceneResult read_scene_both(const GltfBuilder& builder);

// The message of the Error(invalid_data); "read" if there is none.
std::string scene_refusal(const GltfBuilder& builder);

// What read_scene promises for every result.
void expect_valid(const SceneResult& result);

} // namespace spa::test
