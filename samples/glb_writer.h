// SPDX-License-Identifier: Apache-2.0
// A binary glTF 2.0 file in the making. Internal to this folder.
#pragma once

#include "../libspa/mesh/model.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace spa::samples {

class GlbWriter {
public:
    using Json = nlohmann::ordered_json; // keeps the order of insertion: equal bytes on every run

    // All but meshes, materials and data, which finish() adds: scenes, nodes, cameras.
    Json json;

    // materials and textures: those that the meshes' materials are indices into. All outlive the writer.
    GlbWriter(const std::vector<Material>& materials, const std::vector<Texture>& textures)
        : materials_(materials), textures_(textures), numbers_(materials.size(), no_index) {}

    // Adds a mesh of one primitive a material and returns its number; the materials and textures of
    // `geometry` do not count. Throws Error(internal) if it breaks the rules of model.h.
    std::size_t add_mesh(const Model& geometry);

    // The file. Materials that no mesh uses are left out, and so are the textures of those. Throws
    // Error(unsupported) if it would reach 4 GiB, Error(internal) if a texture cannot be encoded.
    std::vector<std::byte> finish() &&;

private:
    std::size_t add_view(const void* bytes, std::size_t size, int target);
    std::size_t add_accessor(std::size_t view, int component, std::size_t count, const char* type);
    template <class T>
    std::size_t add_attribute(const std::vector<T>& values, const char* type);
    Json add_attributes(const Model& geometry);
    std::size_t add_indices(const Model& geometry, std::uint32_t material);
    std::size_t add_texture(const Material& material);
    void add_materials();
    [[nodiscard]] std::vector<std::byte> assemble() const;
    void check(const Model& geometry) const;

    const std::vector<Material>& materials_;
    const std::vector<Texture>& textures_;
    std::vector<std::uint32_t> numbers_; // in the file, of materials_; no_index: not used so far
    std::vector<const Material*> used_;  // in the order of the file
    bool any_uvs_ = false;
    Json accessors_ = Json::array(), views_ = Json::array();
    std::vector<std::byte> binary_;
};

} // namespace spa::samples
