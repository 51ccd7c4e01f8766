// SPDX-License-Identifier: Apache-2.0
// EXT_meshopt_compression and KHR_draco_mesh_compression: encoded by the libraries' own encoders, imported,
// compared with what went in.
#include "compressed_builder.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace spa::test {
namespace {

spa::import::Result import_meshopt(const GltfBuilder& builder) {
    const Scratch scratch;
    return scratch.read("a.glb", with_fallback_buffer(builder).glb());
}

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
    EXPECT_NE(refusal(claim).find("claims 134217728 triangles and 4 vertices in 21 bytes"),
              std::string::npos);
}

} // namespace
} // namespace spa::test
