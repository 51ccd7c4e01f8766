// SPDX-License-Identifier: Apache-2.0
// Khronos glTF 2.0 specification, section 4, "GLB File Format".
#include "glb_writer.h"

#include "../libspa/core/error.h"
#include "png.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>

namespace spa::samples {
namespace {

using Json = GlbWriter::Json;

static_assert(std::endian::native == std::endian::little, "vertex data is written as it lies in memory");

// Constants of the specification.
constexpr int component_u16 = 5123, component_u32 = 5125, component_f32 = 5126;
constexpr int target_vertices = 34962, target_indices = 34963;
constexpr int filter_nearest = 9728, filter_linear = 9729, filter_linear_mipmap_linear = 9987;
constexpr int wrap_repeat = 10497, wrap_mirrored = 33648, wrap_clamp = 33071;
constexpr std::uint32_t glb_magic = 0x46546C67, chunk_json = 0x4E4F534A, chunk_binary = 0x004E4942;

[[noreturn]] void fail(const std::string& what) {
    throw Error(ExitCode::internal, "GLB writer: the model " + what);
}

int wrap_code(Wrap wrap) {
    switch (wrap) {
    case Wrap::repeat: return wrap_repeat;
    case Wrap::mirrored_repeat: return wrap_mirrored;
    case Wrap::clamp_to_edge: return wrap_clamp;
    }
    return wrap_repeat;
}

const char* alpha_mode_name(AlphaMode mode) {
    switch (mode) {
    case AlphaMode::opaque: return "OPAQUE";
    case AlphaMode::mask: return "MASK";
    case AlphaMode::blend: return "BLEND";
    }
    return "OPAQUE";
}

} // namespace

std::size_t GlbWriter::add_view(const void* bytes, std::size_t size, int target) {
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    views_.push_back(std::move(view));
    const auto* first = static_cast<const std::byte*>(bytes);
    binary_.insert(binary_.end(), first, first + size);
    binary_.resize((binary_.size() + 3) / 4 * 4); // every view starts on a multiple of 4
    return views_.size() - 1;
}

std::size_t GlbWriter::add_accessor(std::size_t view, int component, std::size_t count, const char* type) {
    accessors_.push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessors_.size() - 1;
}

template <class T>
std::size_t GlbWriter::add_attribute(const std::vector<T>& values, const char* type) {
    const std::size_t view = add_view(values.data(), values.size() * sizeof(T), target_vertices);
    return add_accessor(view, component_f32, values.size(), type);
}

GlbWriter::Json GlbWriter::add_attributes(const Model& geometry) {
    Json attributes;
    static_assert(sizeof(Vec3f) == 12 && sizeof(Vec2f) == 8 && sizeof(Vec4f) == 16);
    const std::size_t position = add_attribute(geometry.positions, "VEC3");
    Vec3f low = geometry.positions.front(), high = low;
    for (const Vec3f& p : geometry.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    accessors_[position]["min"] = {low.x, low.y, low.z};
    accessors_[position]["max"] = {high.x, high.y, high.z};
    attributes["POSITION"] = position;
    if (!geometry.normals.empty()) attributes["NORMAL"] = add_attribute(geometry.normals, "VEC3");
    if (!geometry.uvs.empty()) attributes["TEXCOORD_0"] = add_attribute(geometry.uvs, "VEC2");
    if (!geometry.colors.empty()) attributes["COLOR_0"] = add_attribute(geometry.colors, "VEC4");
    return attributes;
}

// The largest index of a type restarts primitives and may not be used.
std::size_t GlbWriter::add_indices(const Model& geometry, std::uint32_t material) {
    std::vector<std::uint32_t> wide;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i)
        if (geometry.triangle_materials[i] == material)
            wide.insert(wide.end(), geometry.triangles[i].vertex.begin(), geometry.triangles[i].vertex.end());
    if (wide.empty()) return 0;
    if (geometry.positions.size() > 0xFFFF) {
        const std::size_t view = add_view(wide.data(), wide.size() * 4, target_indices);
        return add_accessor(view, component_u32, wide.size(), "SCALAR");
    }
    std::vector<std::uint16_t> narrow;
    narrow.reserve(wide.size());
    for (const std::uint32_t index : wide) narrow.push_back(static_cast<std::uint16_t>(index));
    const std::size_t view = add_view(narrow.data(), narrow.size() * 2, target_indices);
    return add_accessor(view, component_u16, narrow.size(), "SCALAR");
}

void GlbWriter::check(const Model& model) const {
    const auto matches = [&](std::size_t count) { return count == 0 || count == model.positions.size(); };
    if (model.triangles.empty()) fail("has no triangles");
    if (!matches(model.normals.size()) || !matches(model.uvs.size()) || !matches(model.colors.size()))
        fail("has attributes of different lengths");
    if (model.triangle_materials.size() != model.triangles.size()) fail("lacks materials of triangles");
    for (const Triangle& triangle : model.triangles)
        for (const std::uint32_t index : triangle.vertex)
            if (index >= model.positions.size()) fail("has a vertex index out of range");
    for (const std::uint32_t material : model.triangle_materials)
        if (material >= materials_.size()) fail("has a material index out of range");
    for (const Material& material : materials_)
        if (material.texture != no_index &&
            (material.texture >= textures_.size() || textures_[material.texture].mips.empty()))
            fail("has a material without its texture");
}

std::size_t GlbWriter::add_mesh(const Model& geometry) {
    check(geometry);
    any_uvs_ = any_uvs_ || !geometry.uvs.empty();
    const Json attributes = add_attributes(geometry);
    Json primitives = Json::array();
    for (std::uint32_t material = 0; material < materials_.size(); ++material) {
        const std::size_t indices = add_indices(geometry, material);
        if (indices == 0) continue;
        if (numbers_[material] == no_index) {
            numbers_[material] = static_cast<std::uint32_t>(used_.size());
            used_.push_back(&materials_[material]);
        }
        primitives.push_back(
            {{"attributes", attributes}, {"indices", indices}, {"material", numbers_[material]}});
    }
    json["meshes"].push_back({{"primitives", std::move(primitives)}});
    return json["meshes"].size() - 1;
}

std::vector<std::byte> GlbWriter::finish() && {
    add_materials();
    json["accessors"] = std::move(accessors_);
    json["bufferViews"] = std::move(views_);
    json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    return assemble();
}

std::size_t GlbWriter::add_texture(const Material& material) {
    const Texture& source = textures_[material.texture];
    const std::vector<std::byte> png = encode_png(source.mips.front(), source.name);
    const std::size_t view = add_view(png.data(), png.size(), 0);
    json["samplers"].push_back(
        {{"magFilter", material.nearest ? filter_nearest : filter_linear},
         {"minFilter", material.nearest ? filter_nearest : filter_linear_mipmap_linear},
         {"wrapS", wrap_code(material.wrap_u)},
         {"wrapT", wrap_code(material.wrap_v)}});
    json["images"].push_back({{"name", source.name}, {"mimeType", "image/png"}, {"bufferView", view}});
    const std::size_t index = json["textures"].size();
    json["textures"].push_back({{"sampler", index}, {"source", index}});
    return index;
}

void GlbWriter::add_materials() {
    Json materials = Json::array();
    for (const Material* material : used_) {
        Json surface = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
        const Vec4f& base = material->base_color;
        if (base != Vec4f{1, 1, 1, 1}) surface["baseColorFactor"] = {base.x, base.y, base.z, base.w};
        if (material->texture != no_index && any_uvs_)
            surface["baseColorTexture"] = {{"index", add_texture(*material)}};
        Json entry;
        if (!material->name.empty()) entry["name"] = material->name;
        entry["pbrMetallicRoughness"] = std::move(surface);
        if (material->alpha_mode != AlphaMode::opaque)
            entry["alphaMode"] = alpha_mode_name(material->alpha_mode);
        if (material->alpha_mode == AlphaMode::mask) entry["alphaCutoff"] = material->alpha_cutoff;
        if (material->double_sided) entry["doubleSided"] = true;
        materials.push_back(std::move(entry));
    }
    json["materials"] = std::move(materials);
}

std::vector<std::byte> GlbWriter::assemble() const {
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t total = 12 + 8 + text.size() + 8 + binary_.size();
    if (total > std::numeric_limits<std::uint32_t>::max())
        throw Error(ExitCode::unsupported, "GLB writer: the model does not fit into 4 GiB");
    std::vector<std::byte> out;
    out.reserve(total);
    const auto put = [&out](const void* bytes, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(bytes);
        out.insert(out.end(), first, first + size);
    };
    const auto put_words = [&put](std::initializer_list<std::uint32_t> words) {
        put(words.begin(), words.size() * 4);
    };
    put_words({glb_magic, 2, static_cast<std::uint32_t>(total)});
    put_words({static_cast<std::uint32_t>(text.size()), chunk_json});
    put(text.data(), text.size());
    put_words({static_cast<std::uint32_t>(binary_.size()), chunk_binary});
    put(binary_.data(), binary_.size());
    return out;
}

} // namespace spa::samples
