// SPDX-License-Identifier: Apache-2.0
// Base colours: metallic-roughness or KHR_materials_pbrSpecularGlossiness, with KHR_texture_transform and the
// texture's sampler.
#pragma once

#include "gltf_images.h"
#include "tinygltf.h"

#include <cstdint>
#include <vector>

namespace spa::import::gltf {

// Where a material's base-colour texture takes its uv from.
struct UvSource {
    std::size_t set = 0; // TEXCOORD_n
    // uv' = (m[0] u + m[1] v + m[2], m[3] u + m[4] v + m[5])
    std::array<double, 6> matrix{1, 0, 0, 0, 1, 0};
    bool identity = true;
};

class Materials {
public:
    // Converts every material of the document into out.materials, in order; the textures of those that are
    // `used` are decoded into out.textures.
    Materials(const tinygltf::Model& model, const std::vector<bool>& used, Images& images, Model& out,
              const Context& context);

    [[nodiscard]] const UvSource& uv(std::size_t material) const { return uv_[material]; }

    // The material of primitives that have none, appended when first asked for.
    std::uint32_t default_material();
    // The material without its texture, for primitives without the uv set that it wants.
    std::uint32_t untextured(std::uint32_t material);

private:
    Model& out_;
    std::vector<UvSource> uv_;
    std::map<std::uint32_t, std::uint32_t> untextured_;
    std::uint32_t default_ = no_index;
};

} // namespace spa::import::gltf
