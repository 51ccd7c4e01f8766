// SPDX-License-Identifier: Apache-2.0
#include "scene_materials.h"

#include "../core/error.h"

#include <bit>
#include <cmath>

namespace spa::render {
namespace {

std::uint32_t wrap_of(Wrap wrap) {
    switch (wrap) {
    case Wrap::mirrored_repeat: return SPA_WRAP_MIRRORED;
    case Wrap::clamp_to_edge: return SPA_WRAP_CLAMP;
    case Wrap::repeat: break;
    }
    return SPA_WRAP_REPEAT;
}

float alpha_limit(const Material& material) {
    switch (material.alpha_mode) {
    case AlphaMode::mask: return material.alpha_cutoff;
    case AlphaMode::blend: return 0.5F;
    case AlphaMode::opaque: break;
    }
    return 0;
}

shader::float3 convert(Vec3f v) { return {v.x, v.y, v.z}; }

} // namespace

SceneMaterials make_materials(const Model& model, const std::vector<bool>& used) {
    SceneMaterials result;
    for (const Material& material : model.materials) {
        data::RenderMaterial& out = result.materials.emplace_back();
        out.color = {material.base_color.x, material.base_color.y, material.base_color.z};
        out.alpha = material.base_color.w;
        out.alpha_limit = alpha_limit(material);
        out.texture = model.uvs.empty() ? SPA_NO_TEXTURE : material.texture; // no_index is SPA_NO_TEXTURE
        out.wrap_u = wrap_of(material.wrap_u);
        out.wrap_v = wrap_of(material.wrap_v);
        out.nearest = material.nearest ? 1 : 0;
    }
    for (std::size_t i = 0; i < model.textures.size(); ++i) {
        const Image& image = model.textures[i].mips.front();
        result.textures.push_back({std::uint32_t(result.texels.size()), image.width, image.height});
        if (!used[i]) continue;
        if (result.texels.size() + image.pixels.size() > no_index / 2)
            throw Error(ExitCode::unsupported,
                        "the textures of the scene have more than 2^31 texels; make them smaller");
        for (const auto& pixel : image.pixels)
            result.texels.push_back(std::uint32_t(pixel[0]) | std::uint32_t(pixel[1]) << 8U |
                                    std::uint32_t(pixel[2]) << 16U | std::uint32_t(pixel[3]) << 24U);
    }
    return result;
}

std::vector<data::RenderLight> make_lights(std::span<const Light> lights) {
    std::vector<data::RenderLight> result;
    for (const Light& light : lights) {
        data::RenderLight& out = result.emplace_back();
        switch (light.kind) {
        case LightKind::point: out.kind = SPA_LIGHT_POINT; break;
        case LightKind::directional: out.kind = SPA_LIGHT_DIRECTIONAL; break;
        case LightKind::spot: out.kind = SPA_LIGHT_SPOT; break;
        }
        out.position = convert(to_float(light.position));
        out.direction = convert(to_float(light.direction));
        out.intensity = convert(light.intensity);
        out.cos_outer = float(std::cos(light.outer_cone));
        // A cone with a hard edge has a ramp too, of the smallest width.
        out.cos_inner = std::max(float(std::cos(light.inner_cone)), std::nextafter(out.cos_outer, 2.0F));
    }
    return result;
}

} // namespace spa::render
