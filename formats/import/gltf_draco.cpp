// SPDX-License-Identifier: Apache-2.0
#include "gltf_draco.h"

#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/mesh/mesh.h>

namespace spa::import::gltf {
namespace {

// What a header may claim for each compressed byte; the decoder allocates by the header. Real meshes take
// more than a bit for a triangle, and flat grids a little less.
constexpr std::uint64_t max_triangles_per_byte = 64;

// What the decoder itself takes for a triangle, measured: corner tables, traversal, indices.
constexpr std::uint64_t decoder_bytes_per_triangle = 256;

// The counts that the data begins with, before anything is allocated for them.
struct Claim {
    bool edgebreaker = false;
    std::uint64_t triangles = 0, vertices = 0;
};

// Layout: "DRACO", version 2 x u8, geometry type u8, method u8, flags u16, then for method 1 (edgebreaker) u8
// traversal, varint vertices, varint triangles and for method 0 (sequential) varint triangles, varint
// vertices. Metadata come first if flag bit 15 is set. glTF exporters write version 2.2 and no metadata.
Claim read_claim(std::span<const std::byte> bytes, const std::string& place, const Context& context) {
    const auto u8 = [&](std::size_t i) {
        return i < bytes.size() ? std::to_integer<unsigned>(bytes[i]) : 0U;
    };
    if (bytes.size() < 12 || u8(7) != draco::TRIANGULAR_MESH)
        fail(context, place, "the data is not a Draco mesh");
    if (u8(5) != 2 || u8(6) != 2)
        fail(context, place,
             "the data is of version " + std::to_string(u8(5)) + "." + std::to_string(u8(6)) +
                 "; only 2.2 is read");
    if ((u8(10) & 0x80U) != 0) fail(context, place, "the data has metadata, which is not read");
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
    Claim claim;
    claim.edgebreaker = u8(8) == draco::MESH_EDGEBREAKER_ENCODING;
    if (claim.edgebreaker) ++i;
    const std::uint64_t first = varint(), second = varint();
    claim.triangles = claim.edgebreaker ? second : first;
    claim.vertices = claim.edgebreaker ? first : second;
    return claim;
}

void check_claim(const Claim& claim, std::size_t bytes, const std::string& place, const Context& context) {
    if (claim.triangles > max_triangles_per_byte * bytes || claim.vertices > 3 * claim.triangles)
        fail(context, place,
             "the data claims " + std::to_string(claim.triangles) + " triangles and " +
                 std::to_string(claim.vertices) + " vertices in " + std::to_string(bytes) + " bytes");
    const Limits& limits = context.limits;
    if (claim.triangles > limits.triangles || claim.vertices > limits.vertices ||
        claim.triangles * decoder_bytes_per_triangle > limits.model_bytes)
        fail(context, place,
             "the data claims " + std::to_string(claim.triangles) + " triangles, more than the limits allow");
}

// A decoder that knows what the attributes will take before it decodes them: their headers can claim any
// number, and equal values take no data.
template <class Decoder>
class Bounded final : public Decoder {
public:
    explicit Bounded(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

private:
    bool DecodeAllAttributes() override { // NOLINT(readability-identifier-naming)
        const draco::PointCloud& points = *this->point_cloud();
        std::uint64_t bytes = 0;
        for (int i = 0; i < points.num_attributes(); ++i) {
            // Decoded to 32-bit numbers first, then to the type.
            const draco::PointAttribute& attribute = *points.attribute(i);
            const auto size = static_cast<std::uint64_t>(draco::DataTypeLength(attribute.data_type()));
            bytes += std::uint64_t{attribute.num_components()} * (size + 4) * points.num_points();
            if (bytes > most_bytes_) return false;
        }
        return Decoder::DecodeAllAttributes();
    }

    std::uint64_t most_bytes_;
};

template <class Decoder>
draco::Status decode(std::span<const std::byte> bytes, std::uint64_t most_bytes, draco::Mesh& mesh) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const draco::DecoderOptions options;
    return Bounded<Decoder>(most_bytes).Decode(options, &buffer, &mesh);
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

    const Claim claim = read_claim(bytes, place, context);
    check_claim(claim, bytes.size(), place, context);
    const auto mesh = std::make_unique<draco::Mesh>();
    try {
        const std::uint64_t most = context.limits.model_bytes;
        const draco::Status status = claim.edgebreaker
                                         ? decode<draco::MeshEdgebreakerDecoder>(bytes, most, *mesh)
                                         : decode<draco::MeshSequentialDecoder>(bytes, most, *mesh);
        if (!status.ok()) fail(context, place, "the data is damaged: " + status.error_msg_string());
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
