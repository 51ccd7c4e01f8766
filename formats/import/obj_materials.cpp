// SPDX-License-Identifier: Apache-2.0
#include "obj_materials.h"

#include "../../libspa/core/error.h"
#include "text.h"
#include "texture.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace spa::import {
namespace {

std::string folder_of(const std::string& name) { return name.substr(0, name.rfind('/') + 1); }

bool is_translucent(const Texture& texture) {
    const auto& pixels = texture.mips[0].pixels;
    return std::any_of(pixels.begin(), pixels.end(), [](const auto& pixel) { return pixel[3] < 255; });
}

// A map_d is a scalar picture: its values are stored as they are, not in sRGB. Rec. 709 luma in integers.
std::uint8_t opacity(const std::array<std::uint8_t, 4>& pixel, bool use_alpha) {
    if (use_alpha) return pixel[3];
    return std::uint8_t((2126U * pixel[0] + 7152U * pixel[1] + 722U * pixel[2] + 5000U) / 10000U);
}

// The colour of one picture and the opacity of another as one texture of the size of `out`.
void combine_pixels(const Image& a, const Image& b, bool use_alpha, Image& out) {
    out.pixels.resize(std::size_t{out.width} * out.height);
    for (std::uint32_t y = 0; y < out.height; ++y) {
        for (std::uint32_t x = 0; x < out.width; ++x) {
            const auto nearest = [&](const Image& image) {
                const std::size_t column = std::uint64_t{x} * image.width / out.width;
                const std::size_t row = std::uint64_t{y} * image.height / out.height;
                return image.pixels[row * image.width + column];
            };
            auto pixel = nearest(a);
            pixel[3] = opacity(nearest(b), use_alpha);
            out.pixels[std::size_t{y} * out.width + x] = pixel;
        }
    }
}

Texture white_texture(const Texture& dissolve) {
    Texture white;
    white.name = dissolve.name;
    white.mips.push_back({1, 1, {{255, 255, 255, 255}}});
    return white;
}

} // namespace

// Exporters run where the case of letters in a file name does not matter.
std::optional<ObjMaterials::FoundFile> ObjMaterials::read(std::string_view text) {
    const Reference reference = resolve_reference(asset_.path, text, Encoding::file_name);
    std::string name = reference.name;
    std::optional<FileContent> content = references_.read(reference);
    if (!content) {
        // With a file of that very name the result would be another.
        references_.add_missing(reference.name);
        if (const std::optional<std::string> found = any_case_.find(reference.name)) {
            name = *found;
            content = references_.read({name, asset_.path.parent_path() / name});
        }
    }
    if (!content) return std::nullopt;
    return FoundFile{std::move(name), std::move(*content)};
}

bool ObjMaterials::read_library(std::string_view reference) {
    const auto known = libraries_.find(reference);
    if (known != libraries_.end()) return known->second;
    const auto found = read(reference);
    libraries_.emplace(reference, found.has_value());
    if (!found) return false;
    std::vector<MtlMaterial> materials = parse_mtl(as_text(found->content.bytes), found->name, report_);
    if (materials.size() + materials_.size() > max_materials)
        fail(asset_.path,
             "its material libraries have more than " + std::to_string(max_materials) + " materials");
    for (MtlMaterial& material : materials) {
        const std::string name = material.name;
        materials_.try_emplace(name, Found{std::move(material), found->name});
    }
    return true;
}

void ObjMaterials::read_libraries(std::string_view statement, std::size_t line) {
    if (statement.empty() || read_library(statement)) return;
    std::string_view rest = statement;
    for (std::string_view name = cut_token(rest); !name.empty(); name = cut_token(rest)) {
        if (read_library(name)) continue;
        warn(report_, "line " + std::to_string(line) + ": the material library " + quote(name) +
                          " is missing; put it beside the OBJ file to get its colours and textures.");
    }
}

std::optional<Texture> ObjMaterials::load(const std::optional<MtlMap>& map, const Found& found) {
    if (!map) return std::nullopt;
    const std::string where =
        "material " + quote(found.material.name) + " of " + found.library + ": texture " + quote(map->file);
    auto file = read(map->file);
    if (!file) file = read(folder_of(found.library) + map->file);
    if (!file) {
        warn(report_, where + " is missing; the material goes without it.");
        return std::nullopt;
    }
    try {
        return budget_.decode_part(file->content.bytes, file->name);
    } catch (const Error& error) {
        throw Error(error.code(), asset_.path.string() + ": " + where + ": " + error.what());
    }
}

Texture ObjMaterials::combine(std::optional<Texture> color, const std::optional<Texture>& dissolve) {
    if (!dissolve) {
        budget_.claim(color->mips[0].width, color->mips[0].height, color->name);
        return std::move(*color);
    }
    const Texture white = white_texture(*dissolve);
    const Texture& a = color ? *color : white;
    const Image& from = a.mips[0];
    const Image& alpha = dissolve->mips[0];
    Texture texture;
    texture.name = a.name == dissolve->name ? a.name : a.name + " + " + dissolve->name;
    Image& out = texture.mips.emplace_back();
    out.width = std::max(from.width, alpha.width);
    out.height = std::max(from.height, alpha.height);
    budget_.claim(out.width, out.height, texture.name);
    combine_pixels(from, alpha, is_translucent(*dissolve), out);
    build_mips(texture);
    return texture;
}

ObjMaterials::MadeTexture ObjMaterials::make_texture(const Found& found, std::vector<Texture>& textures) {
    const auto& [color_map, dissolve_map] = std::tie(found.material.map_diffuse, found.material.map_dissolve);
    const std::string folder = folder_of(found.library);
    const std::pair<std::string, std::string> key{color_map ? folder + "|" + color_map->file : "",
                                                  dissolve_map ? folder + "|" + dissolve_map->file : ""};
    if (const auto made = made_.find(key); made != made_.end()) return made->second;
    std::optional<Texture> color = load(color_map, found);
    const std::optional<Texture> dissolve = load(dissolve_map, found);
    MadeTexture made;
    if (color || dissolve) {
        made.index = std::uint32_t(textures.size());
        try {
            textures.push_back(combine(std::move(color), dissolve));
        } catch (const Error& error) {
            throw Error(error.code(), asset_.path.string() + ": material " + quote(found.material.name) +
                                          " of " + found.library + ": " + error.what());
        }
        made.blends = dissolve.has_value() || is_translucent(textures.back());
    }
    made_.emplace(key, made);
    return made;
}

ObjMaterial ObjMaterials::make(const std::string& name, std::vector<Texture>& textures) {
    ObjMaterial result;
    Material& material = result.material;
    material.name = name.empty() ? "default" : name;
    if (name.empty()) return result;
    const auto it = materials_.find(name);
    if (it == materials_.end()) {
        warn(report_, "The material " + quote(name) + " is in no material library; it is white.");
        return result;
    }
    const Found& found = it->second;
    const MtlMaterial& mtl = found.material;
    const MadeTexture texture = make_texture(found, textures);
    material.texture = texture.index;
    if (texture.blends) material.alpha_mode = AlphaMode::blend;

    Vec3f diffuse = mtl.diffuse.value_or(Vec3f{1, 1, 1});
    if (diffuse == Vec3f{} && mtl.map_diffuse && texture.index != no_index) diffuse = {1, 1, 1};
    float alpha = 1;
    if (mtl.dissolve)
        alpha = *mtl.dissolve;
    else if (mtl.transparency && *mtl.transparency < 1)
        alpha = 1 - *mtl.transparency;
    if (alpha <= 0 && mtl.map_dissolve && texture.index != no_index) alpha = 1;
    material.base_color = display_to_linear({diffuse.x, diffuse.y, diffuse.z, alpha});
    if (material.base_color.w < 1) material.alpha_mode = AlphaMode::blend;
    if (material.base_color.w == 0)
        warn(report_, "material " + quote(name) + " of " + found.library + " is fully transparent (d 0).");

    const std::optional<MtlMap>& map = mtl.map_diffuse ? mtl.map_diffuse : mtl.map_dissolve;
    if (map && texture.index != no_index) {
        result.uv_scale = map->scale;
        result.uv_offset = map->offset;
        if (map->clamp) material.wrap_u = material.wrap_v = Wrap::clamp_to_edge;
        if (mtl.map_dissolve &&
            (mtl.map_dissolve->scale != map->scale || mtl.map_dissolve->offset != map->offset))
            warn(report_, "material " + quote(name) + " of " + found.library +
                              ": the -s and -o of map_d differ from those of map_Kd; the latter are used.");
    }
    return result;
}

} // namespace spa::import
