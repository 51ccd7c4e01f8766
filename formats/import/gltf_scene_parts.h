// SPDX-License-Identifier: Apache-2.0
// What a scene has beside its triangles: nodes, cameras, lights.
#pragma once

#include "../../libspa/mesh/scene.h"
#include "gltf_scene.h"
#include "gltf_schema.h"

#include <optional>
#include <vector>

namespace spa::import::gltf {

// The document's own lists, not placed yet.
struct SceneParts {
    std::vector<std::optional<Camera>> cameras; // nothing: one that is not read
    std::vector<Light> lights;
};

// Checks and reads the cameras and the lights of KHR_lights_punctual. Throws Error(invalid_data) with the
// place of the first defect. The document passed the checks of a model.
SceneParts read_scene_parts(Json& document, const Context& context);

// Appends a scene node for each place, with its cameras and lights. Throws Error(invalid_data) for a
// transform that is not finite, a camera or a light without a direction, and too long names.
void fill_scene(const tinygltf::Model& model, const std::vector<Place>& places, const SceneParts& parts,
                Scene& scene, const Context& context);

} // namespace spa::import::gltf
