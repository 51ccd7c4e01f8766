// SPDX-License-Identifier: Apache-2.0
#include "compressed_builder.h"

#include <algorithm>
#include <stdexcept>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

namespace spa::test {
namespace {

std::string_view bytes_of(const std::vector<unsigned char>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5F};
const std::vector<unsigned> indices{0, 1, 2, 1, 3, 2};

} // namespace

void compress(GltfBuilder& builder, int view, const std::vector<unsigned char>& encoded, std::size_t count,
              std::size_t stride, const char* mode, const char* filter) {
    const int source = builder.add_view(bytes_of(encoded));
    const Json range = builder.json["bufferViews"][std::size_t(source)];
    Json& out = builder.json["bufferViews"][std::size_t(view)];
    out["buffer"] = 1;
    out["byteOffset"] = 0;
    out["byteLength"] = count * stride;
    out["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                    {"byteOffset", range["byteOffset"]},
                                                    {"byteLength", range["byteLength"]},
                                                    {"byteStride", stride},
                                                    {"count", count},
                                                    {"mode", mode},
                                                    {"filter", filter}};
}

GltfBuilder meshopt_quad(bool triangles) {
    GltfBuilder builder;
    const int position_accessor = builder.add_accessor(positions, "VEC3");
    const int index_accessor =
        builder.add_accessor(std::vector<std::uint32_t>(indices.begin(), indices.end()), "SCALAR");
    std::vector<unsigned char> encoded(meshopt_encodeVertexBufferBound(4, 12));
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), positions.data(), 4, 12));
    compress(builder, 0, encoded, 4, 12, "ATTRIBUTES");
    if (triangles) {
        encoded.resize(meshopt_encodeIndexBufferBound(6, 4));
        encoded.resize(meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices.data(), 6));
    } else {
        encoded.resize(meshopt_encodeIndexSequenceBound(6, 4));
        encoded.resize(meshopt_encodeIndexSequence(encoded.data(), encoded.size(), indices.data(), 6));
    }
    compress(builder, 1, encoded, 6, 4, triangles ? "TRIANGLES" : "INDICES");
    builder.add_mesh({{"POSITION", position_accessor}}, index_accessor);
    builder.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    return builder;
}

GltfBuilder with_fallback_buffer(GltfBuilder builder) {
    std::size_t size = 0;
    for (const Json& view : builder.json["bufferViews"])
        if (view["buffer"] == 0)
            size = std::max(size,
                            view.value("byteOffset", std::size_t{0}) + view["byteLength"].get<std::size_t>());
    builder.json["buffers"] = {
        {{"byteLength", size}},
        {{"byteLength", 4096}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return builder;
}

GltfBuilder draco_grid(int n, bool sequential) {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(2 * n * n);
    const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uv = soup.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    int face = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (const bool upper : {false, true}) {
                float p[3][3], t[3][2];
                const int corner[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {1, 1}, {0, 1}}};
                for (int k = 0; k < 3; ++k) {
                    const float px = float(x + corner[upper][k][0]), py = float(y + corner[upper][k][1]);
                    p[k][0] = t[k][0] = px;
                    p[k][1] = t[k][1] = py;
                    p[k][2] = float(int(px * py) % 3);
                }
                soup.SetAttributeValuesForFace(position, draco::FaceIndex(unsigned(face)), p[0], p[1], p[2]);
                soup.SetAttributeValuesForFace(uv, draco::FaceIndex(unsigned(face)), t[0], t[1], t[2]);
                ++face;
            }
    const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                         : draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("Draco encodes nothing");

    GltfBuilder builder;
    const int view = builder.add_view({buffer.data(), buffer.size()});
    const std::size_t vertices =
        encoder.num_encoded_points() > 0 ? encoder.num_encoded_points() : mesh->num_points();
    builder.json["accessors"] = {
        {{"componentType", 5126},
         {"count", vertices},
         {"type", "VEC3"},
         {"min", {0, 0, 0}},
         {"max", {n, n, 2}}},
        {{"componentType", 5126}, {"count", vertices}, {"type", "VEC2"}},
        {{"componentType", 5125}, {"count", mesh->num_faces() * 3}, {"type", "SCALAR"}}};
    Json& primitive = builder.add_mesh({{"POSITION", 0}, {"TEXCOORD_0", 1}}, 2);
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view},
        {"attributes",
         {{"POSITION", mesh->attribute(position)->unique_id()},
          {"TEXCOORD_0", mesh->attribute(uv)->unique_id()}}}};
    builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return builder;
}

} // namespace spa::test
