// SPDX-License-Identifier: Apache-2.0
#include "gltf_material.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spa::import::gltf {
namespace {

struct TextureUse {
    int texture = -1;
    UvSource uv;
};

double number(const tinygltf::Value& object, const char* key, double missing) {
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : missing;
}

double element(const tinygltf::Value& object, const char* key, int i, double missing) {
    return object.Has(key) ? object.Get(key).Get(i).GetNumberAsDouble() : missing;
}

// KHR_texture_transform: uv' = offset + rotation * (scale * uv), the rotation such that a positive angle
// turns uv from v to u (counter-clockwise where v grows downwards).
void apply_transform(const tinygltf::Value& extension, UvSource& uv) {
    const double angle = number(extension, "rotation", 0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    const double sx = element(extension, "scale", 0, 1.0), sy = element(extension, "scale", 1, 1.0);
    uv.matrix = {c * sx,  s * sy, element(extension, "offset", 0, 0.0),
                 -s * sx, c * sy, element(extension, "offset", 1, 0.0)};
    uv.identity = false;
    if (extension.Has("texCoord"))
        uv.set = static_cast<std::size_t>(extension.Get("texCoord").GetNumberAsInt());
}

TextureUse base_color_texture(const tinygltf::Material& material) {
    TextureUse use;
    const auto gloss = material.extensions.find("KHR_materials_pbrSpecularGlossiness");
    if (gloss != material.extensions.end()) {
        const tinygltf::Value& extension = gloss->second;
        if (!extension.Has("diffuseTexture")) return use;
        const tinygltf::Value& info = extension.Get("diffuseTexture");
        use.texture = info.Get("index").GetNumberAsInt();
        use.uv.set = static_cast<std::size_t>(number(info, "texCoord", 0.0));
        if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
            apply_transform(info.Get("extensions").Get("KHR_texture_transform"), use.uv);
        return use;
    }
    const tinygltf::TextureInfo& info = material.pbrMetallicRoughness.baseColorTexture;
    use.texture = info.index;
    use.uv.set = static_cast<std::size_t>(info.texCoord);
    const auto transform = info.extensions.find("KHR_texture_transform");
    if (transform != info.extensions.end()) apply_transform(transform->second, use.uv);
    return use;
}

Vec4f base_color_factor(const tinygltf::Material& material, const std::string& where,
                        const Context& context) {
    std::array<double, 4> factor{1, 1, 1, 1};
    const auto gloss = material.extensions.find("KHR_materials_pbrSpecularGlossiness");
    const std::vector<double>& values = material.pbrMetallicRoughness.baseColorFactor;
    for (std::size_t i = 0; i < 4; ++i) {
        if (gloss != material.extensions.end())
            factor[i] = element(gloss->second, "diffuseFactor", static_cast<int>(i), 1.0);
        else if (values.size() == 4)
            factor[i] = values[i];
        if (factor[i] < 0 || factor[i] > 1)
            warn(context, where, "the base colour is outside [0, 1] and clamped");
        factor[i] = std::clamp(factor[i], 0.0, 1.0);
    }
    return {static_cast<float>(factor[0]), static_cast<float>(factor[1]), static_cast<float>(factor[2]),
            static_cast<float>(factor[3])};
}

Wrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp_to_edge;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirrored_repeat : Wrap::repeat;
}

// The image of a texture: its own source, else one that an extension names and that is read. -1: none.
int image_of(const tinygltf::Texture& texture, const std::string& where, const Context& context) {
    if (texture.source >= 0) return texture.source;
    const auto webp = texture.extensions.find("EXT_texture_webp");
    if (webp != texture.extensions.end() && webp->second.Has("source"))
        return webp->second.Get("source").GetNumberAsInt();
    for (const char* name : {"KHR_texture_basisu", "MSFT_texture_dds"})
        if (texture.extensions.count(name) != 0)
            throw Error(ExitCode::unsupported, context.asset.path.string() + ": " + where + " needs " + name +
                                                   ", which is not supported; export PNG or JPEG textures");
    warn(context, where, "has no image: the material is drawn without it");
    return -1;
}

} // namespace

Materials::Materials(const tinygltf::Model& model, const std::vector<bool>& used, Images& images, Model& out,
                     const Context& context)
    : out_(out) {
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        const tinygltf::Material& from = model.materials[i];
        const std::string where = at("materials", i);
        Material to;
        to.name = from.name;
        to.base_color = base_color_factor(from, where, context);
        to.double_sided = from.doubleSided;
        to.alpha_cutoff = static_cast<float>(from.alphaCutoff);
        if (from.alphaMode == "MASK") to.alpha_mode = AlphaMode::mask;
        if (from.alphaMode == "BLEND") to.alpha_mode = AlphaMode::blend;
        const TextureUse use = base_color_texture(from);
        uv_.push_back(use.uv);
        if (use.texture >= 0 && used[i]) {
            const tinygltf::Texture& texture = model.textures[static_cast<std::size_t>(use.texture)];
            const int image =
                image_of(texture, at("textures", static_cast<std::size_t>(use.texture)), context);
            if (image >= 0) to.texture = images.texture(static_cast<std::size_t>(image), out);
            if (texture.sampler >= 0) {
                const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
                to.wrap_u = wrap_of(sampler.wrapS);
                to.wrap_v = wrap_of(sampler.wrapT);
                to.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
            }
        }
        out_.materials.push_back(std::move(to));
    }
}

std::uint32_t Materials::default_material() {
    if (default_ == no_index) {
        default_ = static_cast<std::uint32_t>(out_.materials.size());
        out_.materials.push_back({});
        out_.materials.back().name = "default";
        uv_.push_back({});
    }
    return default_;
}

std::uint32_t Materials::untextured(std::uint32_t material) {
    const auto found = untextured_.find(material);
    if (found != untextured_.end()) return found->second;
    const auto index = static_cast<std::uint32_t>(out_.materials.size());
    Material copy = out_.materials[material];
    copy.texture = no_index;
    out_.materials.push_back(std::move(copy));
    uv_.push_back({});
    untextured_.emplace(material, index);
    return index;
}

} // namespace spa::import::gltf
