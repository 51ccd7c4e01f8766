// SPDX-License-Identifier: Apache-2.0
// EXT_meshopt_compression and KHR_draco_mesh_compression: encoded by the libraries' own encoders, imported,
// compared with what went in.
#include "gltf_builder.h"

#include <algorithm>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace spa::test {
namespace {

std::string_view bytes_of(const std::vector<unsigned char>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5F};
const std::vector<unsigned> indices{0, 1, 2, 1, 3, 2};

// Puts the encoded bytes behind view `view`, whose own range moves to a fallback buffer without data.
void compress(GltfBuilder& builder, int view, const std::vector<unsigned char>& encoded, std::size_t count,
              std::size_t stride, const char* mode, const char* filter = "NONE") {
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

// Positions 12 bytes a vertex, indices as TRIANGLES or INDICES.
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

// With the second, empty buffer. The first one's length is not known before everything is added.
import::Result import_meshopt(GltfBuilder builder){const Json views = builder.json["bufferViews"];
std::size_t size = 0;
for (const Json& view : views)
    if (view["buffer"] == 0)
        size =
            std::max(size, view.value("byteOffset", std::size_t{0}) + view["byteLength"].get<std::size_t>());
builder.json["buffers"] = {
    {{"byteLength", size}},
    {{"byteLength", 4096}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
const Scratch scratch;
return scratch.read("a.glb", builder.glb());
} // namespace

TEST(Compression, MeshoptTrianglesAndIndices) {
    for (const bool triangles : {true, false}) {
        const import::Result result = import_meshopt(meshopt_quad(triangles));
        expect_valid(result);
        ASSERT_EQ(result.model.triangles.size(), 2U);
        EXPECT_NEAR(area(result.model), 0.5 + std::sqrt(1.5) / 2, 1e-6);
        EXPECT_TRUE(result.report.warnings.size() <= 1); // POSITION without bounds
    }
}

TEST(Compression, MeshoptFilters) {
    GltfBuilder builder = meshopt_quad(true);
    // Normals: octahedral, 8 bits. (0, 0) is +z; the third component is the scale of "one".
    const std::vector<std::int8_t> octahedral{0, 0, 127, 0, 127, 0, 127, 0, 0, 127, 127, 0, 0, 0, 127, 0};
    std::vector<unsigned char> encoded(meshopt_encodeVertexBufferBound(4, 4));
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), octahedral.data(), 4, 4));
    const int view = builder.add_view(std::string(16, '\0'), 4);
    compress(builder, view, encoded, 4, 4, "ATTRIBUTES", "OCTAHEDRAL");
    const int normals = builder.add_accessor(view, 0, 5120, 4, "VEC3", true);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    // Positions again: exponential, 24-bit mantissa m and 8-bit exponent e of m 2^e.
    const std::vector<std::uint32_t> exponential{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1U | 0xFFU << 24U};
    encoded.resize(meshopt_encodeVertexBufferBound(4, 12));
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), exponential.data(), 4, 12));
    compress(builder, 0, encoded, 4, 12, "ATTRIBUTES", "EXPONENTIAL");
    const import::Result result = import_meshopt(builder);
    expect_valid(result);
    EXPECT_NEAR(area(result.model), 0.5 + std::sqrt(1.5) / 2, 1e-6);
    expect_near(result.model.normals[0], {0, 0, 1}, 1e-2F);
    expect_near(result.model.normals[1], {1, 0, 0}, 1e-2F);
    expect_near(result.model.normals[2], {0, 1, 0}, 1e-2F);
}

TEST(Compression, MeshoptDamageAndClaims) {
    const auto refused = [](const GltfBuilder& builder) {
        try {
            (void)import_meshopt(builder);
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string("imported");
    };
    GltfBuilder builder = meshopt_quad(true);
    Json& extension = builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
    extension["byteOffset"] = 0;
    EXPECT_NE(refused(builder).find("the compressed data is damaged"), std::string::npos);
    extension["count"] = 4000000000U;
    EXPECT_NE(refused(builder).find("claims 4000000000 elements"), std::string::npos);
    extension["byteOffset"] = 4000000000U;
    EXPECT_NE(refused(builder).find("needs bytes 4000000000"), std::string::npos);
}

// A grid of n x n quads with heights, encoded by Draco.
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
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());

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

TEST(Compression, Draco) {
    for (const bool sequential : {true, false}) {
        const import::Result result = import_both(draco_grid(5, sequential));
        ASSERT_EQ(result.model.triangles.size(), 50U);
        // Compared as a sum over the corners: the order of triangles is the encoder's.
        double sum = 0, expected = 0;
        for (std::size_t t = 0; t < 50; ++t)
            for (const Vec3f& p : corners(result.model, t))
                sum += double(p.x) + 10 * double(p.y) + 100 * double(p.z);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 5; ++x)
                for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}}) {
                    const int px = x + dx, py = y + dy;
                    expected += px + 10 * py + 100 * (px * py % 3);
                }
        EXPECT_NEAR(sum, expected, 1e-2);
    }
}

TEST(Compression, DracoDamageAndClaims) {
    GltfBuilder builder = draco_grid(3, false);
    builder.json["accessors"][0]["count"] = 17;
    builder.json["accessors"][1]["count"] = 17;
    EXPECT_NE(refusal(builder).find("vertices, the accessors 17"), std::string::npos);
    builder = draco_grid(3, false);
    builder.json["bufferViews"][0]["byteLength"] = 60;
    EXPECT_NE(refusal(builder).find("KHR_draco_mesh_compression: the data is damaged"), std::string::npos);
    builder = draco_grid(3, false);
    builder.json["bufferViews"][0]["byteLength"] = 5;
    EXPECT_NE(refusal(builder).find("the data is not a Draco mesh"), std::string::npos);
    builder = draco_grid(3, false);
    builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
                ["POSITION"] = 99;
    EXPECT_NE(refusal(builder).find("the data has no such attribute"), std::string::npos);
    // A header that claims 2^27 triangles: sequential, version 2.2.
    GltfBuilder claim = draco_grid(1, true);
    const std::string header{"DRACO\x02\x02\x01\x00\x00\x00\x80\x80\x80\x40\x04\x00\x00\x00\x00\x00", 21};
    claim.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] =
        claim.add_view(header);
    EXPECT_NE(refusal(claim).find("claims 134217728 triangles in 21 bytes"), std::string::npos);
}

} // namespace spa::test
} // namespace spa::test
