// SPDX-License-Identifier: Apache-2.0
// Materials, textures and lights as the shaders read them.
#pragma once

#include "shaders/data.h"

#include "../mesh/scene.h"

#include <span>
#include <vector>

namespace spa::render {

struct SceneMaterials {
    std::vector<data::RenderMaterial> materials; // one a material of the model
    std::vector<data::RenderTexture> textures;   // one a texture
    std::vector<std::uint32_t> texels;
};

// used: for each texture whether its texels are wanted.
SceneMaterials make_materials(const Model& model, const std::vector<bool>& used);

std::vector<data::RenderLight> make_lights(std::span<const Light> lights);

} // namespace spa::render
