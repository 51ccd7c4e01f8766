// SPDX-License-Identifier: Apache-2.0
// What is fine alone and too much together.
#include "../../libspa/core/error.h"
#include "../import_gltf/compressed_builder.h"
#include "png_bomb.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;

// What the reader says of a file under these limits.
std::string outcome(const fs::path& path, const import::Limits& limits) {
    try {
        return std::to_string(import::read_model(path, limits).model.triangles.size()) + " triangles";
    } catch (const Error& error) {
        EXPECT_TRUE(std::string_view(error.what()).starts_with(path.string())) << error.what();
        return error.what();
    }
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

// So many materials with a picture each, all drawn.
GltfBuilder with_pictures(const std::vector<std::string>& pictures) {
    GltfBuilder builder = triangle();
    const Json attributes = {{"POSITION", 0},
                             {"TEXCOORD_0", builder.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2")}};
    Json primitives = Json::array();
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        builder.json["images"].push_back(
            {{"bufferView", builder.add_view(pictures[i])}, {"mimeType", "image/png"}});
        builder.json["textures"].push_back({{"source", i}});
        builder.json["materials"].push_back(
            {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
        primitives.push_back({{"attributes", attributes}, {"material", i}});
    }
    builder.json["meshes"][0]["primitives"] = primitives;
    return builder;
}

TEST(Totals, TexturesOfAModel) {
    const Scratch scratch;
    import::Limits limits;
    limits.model_bytes = 12U << 20U; // a picture of 1024 x 1024 and its smaller levels take 5.6 million
    const std::string picture = black_png(1024, 1024);
    const fs::path two = scratch.write("two.glb", with_pictures({picture, picture}).glb());
    const fs::path three = scratch.write("three.glb", with_pictures({picture, picture, picture}).glb());
    EXPECT_EQ(outcome(two, limits), "2 triangles");
    EXPECT_SAYS(outcome(three, limits), "images[2]: cannot be decoded as an image: it claims 1024 x 1024");
    EXPECT_EQ(outcome(three, {}), "3 triangles");

    std::string mtl, obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
    std::string ply = "ply\nformat ascii 1.0\n";
    for (const char* name : {"a", "b", "c"}) {
        const std::string file = std::string(name) + ".png";
        scratch.write(file, picture);
        mtl += "newmtl " + std::string(name) + "\nmap_Kd " + file + "\n";
        obj += "usemtl " + std::string(name) + "\nf 1/1 2/1 3/1\n";
        ply += "comment TextureFile " + file + "\n";
    }
    scratch.write("a.mtl", mtl);
    ply += "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const fs::path& path : {scratch.write("a.obj", obj), scratch.write("a.ply", ply)}) {
        EXPECT_SAYS(outcome(path, limits), "c.png: cannot be decoded as an image: it claims 1024 x 1024");
        EXPECT_SAYS(outcome(path, {}), " triangles");
    }
}

TEST(Totals, BytesOfAllFiles) {
    const Scratch scratch;
    const std::string picture = black_png(8, 8, png_chunk("tEXt", std::string(5000, 'a')));
    std::string mtl, obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const char* name : {"a", "b", "c"}) {
        scratch.write(std::string(name) + ".png", picture);
        mtl += "newmtl " + std::string(name) + "\nmap_Kd " + name + ".png\n";
        obj += "usemtl " + std::string(name) + "\nf 1 2 3\n";
    }
    scratch.write("a.mtl", mtl);
    import::Limits limits;
    limits.total_bytes = 12'000;
    EXPECT_SAYS(outcome(scratch.write("a.obj", obj), limits),
                "reads more than the limit of 12000 bytes from all files that it refers to");
    limits.total_bytes = 20'000;
    EXPECT_EQ(outcome(scratch.path("a.obj"), limits), "3 triangles");
}

TEST(Totals, BytesOfAModel) {
    const Scratch scratch;
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 3 4\n"; // 4 * 48 + 2 * 20
    import::Limits limits;
    limits.model_bytes = 231;
    EXPECT_SAYS(outcome(scratch.write("a.obj", obj), limits),
                "model of 232 bytes, more than the limit of 231");
    EXPECT_SAYS(outcome(scratch.write("a.glb", triangle().glb()), {.model_bytes = 163}),
                "makes a model larger than the limit of 163 bytes"); // 3 * 48 + 20
    limits.model_bytes = 232;
    EXPECT_EQ(outcome(scratch.path("a.obj"), limits), "2 triangles");
    EXPECT_EQ(outcome(scratch.path("a.glb"), {.model_bytes = 164}), "1 triangles");
    limits.triangles = 1;
    EXPECT_SAYS(outcome(scratch.path("a.obj"), limits), "has more than the 1 triangles allowed");
}

TEST(Totals, CompressedViews) {
    // Positions in rows of 252 bytes: more than the model takes.
    const std::vector<unsigned char> rows(4 * 252);
    std::vector<unsigned char> encoded(meshopt_encodeVertexBufferBound(4, 252));
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), rows.data(), 4, 252));
    GltfBuilder builder = meshopt_quad(true);
    compress(builder, 0, encoded, 4, 252, "ATTRIBUTES");
    builder.json["bufferViews"][0]["byteStride"] = 252;
    const Scratch scratch;
    const fs::path path = scratch.write("a.glb", with_fallback_buffer(builder).glb());
    EXPECT_SAYS(outcome(path, {.model_bytes = 1031}), // 4 * 252 + 6 * 4
                "the compressed buffer views take more than the limit of 1031 bytes");
    EXPECT_SAYS(outcome(path, {.model_bytes = 1032}), "2 triangles have no area");
}

// Accessors that share their data are not all looked at: the file would be read again for each of them.
TEST(Totals, SharedData) {
    const Scratch scratch;
    GltfBuilder builder = triangle();
    const Json bounded = {{"bufferView", 0}, {"componentType", 5126}, {"count", 3},
                          {"type", "VEC3"},  {"min", {7, 7, 7}},      {"max", {7, 7, 7}}};
    for (int i = 0; i < 3; ++i) builder.json["accessors"].push_back(bounded);
    import::Limits limits;
    limits.vertices = 5; // 20 numbers
    const import::Result few = import::read_model(scratch.write("a.glb", builder.glb()), limits);
    EXPECT_TRUE(has_warning(few.report, "accessors[2].min: is not the minimum"));
    EXPECT_FALSE(has_warning(few.report, "accessors[3].min: is not the minimum"));
    EXPECT_TRUE(has_warning(few.report, "accessors: share more data than is checked"));
    EXPECT_TRUE(has_warning(import::read_model(scratch.path("a.glb")).report, "accessors[3].min: is not"));
}

// The compressed bytes of a document by draco_grid().
std::string draco_bytes(const GltfBuilder& builder) {
    const std::string glb = builder.glb();
    return glb.substr(glb.find("DRACO"));
}

std::string refusal_of_draco(const std::string& bytes, const import::Limits& limits = {}) {
    GltfBuilder builder = draco_grid(3, false);
    builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] =
        builder.add_view(bytes);
    const Scratch scratch;
    return outcome(scratch.write("a.glb", builder.glb()), limits);
}

TEST(Totals, Draco) {
    const std::string bytes = draco_bytes(draco_grid(3, false));
    EXPECT_EQ(refusal_of_draco(bytes), "18 triangles");
    std::string changed = bytes;
    changed[6] = '\1';
    EXPECT_SAYS(refusal_of_draco(changed), "the data is of version 2.1; only 2.2 is read");
    changed = bytes;
    changed[10] = '\x80';
    EXPECT_SAYS(refusal_of_draco(changed), "the data has metadata, which is not read");
    // Vertices and triangles of the header: 3 of the latter for one of the former at least.
    changed = bytes;
    changed[12] = '\x7F';
    EXPECT_SAYS(refusal_of_draco(changed), "the data claims 18 triangles and 127 vertices");
    import::Limits limits;
    limits.model_bytes = 18 * 256 - 1;
    EXPECT_SAYS(refusal_of_draco(bytes, limits), "the data claims 18 triangles, more than the limits allow");
}

// Equal values take no data, so a few bytes of header are an attribute of all points.
TEST(Totals, DracoAttributes) {
    constexpr int side = 40, faces = 2 * side * side, attributes = 60;
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(faces);
    const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    std::vector<int> others;
    for (int i = 0; i < attributes; ++i)
        others.push_back(soup.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT32));
    int face = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (const bool upper : {false, true}) {
                const std::array<std::array<int, 2>, 3> corner =
                    upper ? std::array<std::array<int, 2>, 3>{{{1, 0}, {1, 1}, {0, 1}}}
                          : std::array<std::array<int, 2>, 3>{{{0, 0}, {1, 0}, {0, 1}}};
                std::array<std::array<float, 3>, 3> p{};
                for (std::size_t k = 0; k < 3; ++k)
                    p[k] = {float(x + corner[k][0]), float(y + corner[k][1]), 0};
                const draco::FaceIndex index{unsigned(face++)};
                soup.SetAttributeValuesForFace(position, index, p[0].data(), p[1].data(), p[2].data());
                constexpr std::array<std::uint32_t, 4> zeros{};
                for (const int other : others)
                    soup.SetAttributeValuesForFace(other, index, zeros.data(), zeros.data(), zeros.data());
            }
    const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    const std::string bytes(buffer.data(), buffer.size());
    import::Limits limits;
    limits.model_bytes = faces * 256 + 1;
    EXPECT_SAYS(refusal_of_draco(bytes, limits), "the data is damaged");
    EXPECT_SAYS(refusal_of_draco(bytes), "vertices, the accessors"); // decoded, but not what was asked for
}

} // namespace
} // namespace spa::test
