// SPDX-License-Identifier: Apache-2.0
#include "gltf_draco.h"

#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

namespace spa::import::gltf {
namespace {

// What a header may claim for each compressed byte; the decoder allocates by the header. Real meshes take
// more than a bit for a triangle, and flat grids a little less.
constexpr std::uint64_t max_triangles_per_byte = 64;

// The number of triangles in the header, before anything is allocated for them; none if it is cut off.
// Layout: "DRACO", version 2 x u8, geometry type u8, method u8, flags u16, optional metadata, then (version
// 2.2) for method 1 (edgebreaker) u8 traversal, varint vertices, varint triangles and for method 0
// (sequential) varint triangles. Metadata comes first only if flag bit 15 is set: glTF exporters write none.
struct Header {
    unsigned geometry = 0;
    std::optional<std::uint64_t> triangles;
};

Header read_header(std::span<const std::byte> bytes) {
    Header header;
    const auto u8 = [&](std::size_t i) {
        return i < bytes.size() ? std::to_integer<unsigned>(bytes[i]) : 0U;
    };
    header.geometry = u8(7);
    if (bytes.size() < 12 || u8(5) != 2 || u8(6) < 2 || (u8(10) & 0x80U) != 0) return header;
    std::size_t i = 11;
    const auto varint = [&]() -> std::uint64_t {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 35 && i < bytes.size(); shift += 7) {
            const unsigned byte = u8(i++);
            value |= std::uint64_t{byte & 0x7FU} << shift;
            if ((byte & 0x80U) == 0) break;
        }
        return value;
    };
    if (u8(8) == 1) {
        ++i;
        (void)varint();
    }
    header.triangles = varint();
    return header;
}

int component_type_of(draco::DataType type) {
    switch (type) {
    case draco::DT_INT8: return TINYGLTF_COMPONENT_TYPE_BYTE;
    case draco::DT_UINT8: return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    case draco::DT_INT16: return TINYGLTF_COMPONENT_TYPE_SHORT;
    case draco::DT_UINT16: return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    case draco::DT_UINT32: return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    case draco::DT_FLOAT32: return TINYGLTF_COMPONENT_TYPE_FLOAT;
    default: return -1;
    }
}

// The attribute's values, one a point. False for a type that glTF has not and for maps that lead outside.
bool copy_attribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute, bool normalized,
                    std::vector<std::byte>& storage, Elements& elements) {
    const auto components = static_cast<std::size_t>(attribute.num_components());
    const auto size = static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type())) * components;
    const int type = component_type_of(attribute.data_type());
    if (type < 0 || size == 0 || attribute.buffer() == nullptr) return false;
    const std::size_t available = attribute.buffer()->data_size();
    storage.resize(size * mesh.num_points());
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex value = attribute.mapped_index(point);
        if (value.value() >= attribute.size()) return false;
        const auto offset = static_cast<std::size_t>(attribute.GetBytePos(value));
        if (offset > available || size > available - offset) return false;
        std::memcpy(storage.data() + size * point.value(), attribute.buffer()->data() + offset, size);
    }
    elements = {storage, size, mesh.num_points(), type, components, normalized};
    return true;
}

} // namespace

DracoMesh decode_draco(const tinygltf::Model& model, const tinygltf::Primitive& primitive, Buffers& buffers,
                       const std::string& where, const Context& context) {
    const std::string place = where + ".extensions.KHR_draco_mesh_compression";
    const tinygltf::Value& extension = primitive.extensions.at("KHR_draco_mesh_compression");
    const std::span<const std::byte> bytes =
        buffers.view(static_cast<std::size_t>(extension.Get("bufferView").GetNumberAsInt()));
    buffers.claim_compressed(bytes.size(), place);
    const std::size_t claimed =
        model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))].count;

    const Header header = read_header(bytes);
    if (header.geometry != draco::TRIANGULAR_MESH) fail(context, place, "the data is not a Draco mesh");
    if (header.triangles && *header.triangles > max_triangles_per_byte * bytes.size())
        fail(context, place,
             "the data claims " + std::to_string(*header.triangles) + " triangles in " +
                 std::to_string(bytes.size()) + " bytes");
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::unique_ptr<draco::Mesh> mesh;
    try {
        draco::Decoder decoder;
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok())
            fail(context, place, "the data is damaged: " + decoded.status().error_msg_string());
        mesh = std::move(decoded).value();
    } catch (const std::bad_alloc&) {
        fail(context, place, "the data claims more memory than there is");
    } catch (const std::length_error&) {
        fail(context, place, "the data claims more memory than there is");
    }

    DracoMesh result;
    result.vertices = mesh->num_points();
    if (result.vertices != claimed)
        fail(context, place,
             "the data has " + std::to_string(result.vertices) + " vertices, the accessors " +
                 std::to_string(claimed));
    result.indices.reserve(std::size_t{mesh->num_faces()} * 3);
    for (draco::FaceIndex face(0); face < mesh->num_faces(); ++face)
        for (const draco::PointIndex& point : mesh->face(face)) result.indices.push_back(point.value());

    const tinygltf::Value& ids = extension.Get("attributes");
    for (const std::string& name : ids.Keys()) {
        const auto accessor = primitive.attributes.find(name);
        if (accessor == primitive.attributes.end()) continue;
        const draco::PointAttribute* attribute =
            mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(ids.Get(name).GetNumberAsInt()));
        const bool normalized = model.accessors[static_cast<std::size_t>(accessor->second)].normalized;
        if (attribute == nullptr ||
            !copy_attribute(*mesh, *attribute, normalized, result.storage[name], result.attributes[name]))
            fail(context, place + ".attributes." + name, "the data has no such attribute");
    }
    if (result.attributes.count("POSITION") == 0) fail(context, place + ".attributes", "has no POSITION");
    return result;
}

} // namespace spa::import::gltf
