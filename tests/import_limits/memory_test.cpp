// SPDX-License-Identifier: Apache-2.0
// Small files that ask for a lot: what another process needs at most to read or refuse them.
#include "../import_gltf/compressed_builder.h"
#include "png_bomb.h"

#include <array>
#include <cstdio>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;

struct Outcome {
    std::string model, scene;   // what read_model and read_scene said
    std::size_t peak_bytes = 0; // of the process; 0: not known
};

Outcome read_in_another_process(const fs::path& path) {
    Outcome outcome;
    std::FILE* const pipe = ::popen((std::string(SPA_READ_ASSET) + " '" + path.string() + "'").c_str(), "r");
    if (pipe == nullptr) return outcome;
    std::string text;
    std::array<char, 4096> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
        text.append(buffer.data(), count);
    EXPECT_EQ(::pclose(pipe), 0) << text;
    const std::size_t first = text.find('\n'), second = text.find('\n', first + 1);
    if (second == std::string::npos) return outcome;
    outcome.model = text.substr(0, first);
    outcome.scene = text.substr(first + 1, second - first - 1);
    outcome.peak_bytes = std::size_t(std::stoul(text.substr(second + 1))) * 1024;
    return outcome;
}

constexpr std::size_t mebi = std::size_t{1} << 20U;

class Memory : public testing::Test {
protected:
    void SetUp() override {
        least_ = read_in_another_process(scratch_.write("triangle.glb", triangle().glb())).peak_bytes;
        if (least_ == 0) GTEST_SKIP() << "under a sanitizer memory says nothing";
    }

    // The process may take `most_bytes` more than it does for a triangle.
    void expect(const std::string& name, std::string_view content, const std::string& message,
                std::size_t most_bytes) {
        const Outcome outcome = read_in_another_process(scratch_.write(name, content));
        EXPECT_NE(outcome.model.find(message), std::string::npos) << outcome.model;
        EXPECT_LE(outcome.peak_bytes, least_ + most_bytes) << name << ": " << content.size() << " bytes";
    }

    Scratch scratch_;
    std::size_t least_ = 0;
};

const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string gltf_head = R"({"asset":{"version":"2.0"},)";

std::string repeated(const std::string& text, std::size_t count) {
    std::string out;
    out.reserve(text.size() * count);
    for (std::size_t i = 0; i < count; ++i) out += text;
    return out;
}

// A strip of so many vertices, drawn by node 0.
GltfBuilder strip(std::size_t vertices) {
    GltfBuilder builder;
    std::vector<float> positions;
    for (std::size_t i = 0; i < vertices; ++i)
        for (const std::size_t value : {i, i * i % 7, i % 3}) positions.push_back(float(value));
    builder.add_mesh({{"POSITION", builder.add_accessor(positions, "VEC3")}})["mode"] = 5;
    return builder;
}

TEST_F(Memory, ValuesOfJson) {
    expect("a.gltf", gltf_head + R"("extras":[)" + repeated("[0],", 1'000'000) + "0]}", "has no meshes",
           48 * 4 * mebi);
    expect("b.gltf", gltf_head + R"("extras":[)" + repeated("0,", 17'000'000) + "0]}",
           "the JSON has more than 16777216 values", 3 * 34 * mebi);
    expect("c.gltf", gltf_head + R"("materials":[)" + repeated("{},", 70'000) + "{}]}",
           "materials: has 70001 elements, more than the limit of 65536", 32 * mebi);
    expect("e.gltf",
           gltf_head +
               R"("meshes":[{"primitives":[{"attributes":{}}]}],"nodes":[{"mesh":0,"extensions":)"
               R"({"EXT_mesh_gpu_instancing":{"attributes":{},"a":[)" +
               repeated("[0],", 1'000'000) + "0]}}}]}",
           "nothing to bake", 48 * 4 * mebi);
    expect("d.gltf", gltf_head + R"("meshes":[{"primitives":[)" + repeated("0,", 2'100'000) + "0]}]}",
           "meshes.primitives: has 2100001 elements", 32 * 4 * mebi);
}

// Each of the 60 levels has two nodes, each of which draws both of the level below.
TEST_F(Memory, NodesThatMultiply) {
    for (const std::size_t levels : {18U, 60U}) {
        GltfBuilder builder = strip(1000);
        builder.json["nodes"].push_back(builder.json["nodes"][0]);
        for (std::size_t i = 0; i < levels; ++i)
            for (int k = 0; k < 2; ++k) builder.json["nodes"].push_back({{"children", {2 * i, 2 * i + 1}}});
        builder.json["scenes"] = {{{"nodes", {2 * levels}}}};
        expect("a.glb", builder.glb(),
               levels == 18 ? "the scene makes a model larger than the limit" : "multiply to more than",
               400 * mebi);
    }
}

TEST_F(Memory, InstancesThatMultiply) {
    GltfBuilder builder = strip(10'000);
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        builder.add_accessor(std::vector<float>(3 * 50'000), "VEC3");
    expect("a.glb", builder.glb(), "the scene makes a model larger than the limit", 32 * mebi);
    builder.json["accessors"][1]["count"] = 100'000;
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        builder.add_accessor(std::vector<float>(3 * 2'000'000), "VEC3");
    builder.json["accessors"][1]["count"] = 50'000;
    expect("b.glb", builder.glb(), "multiply to more than 1048576 drawings", 4 * 24 * mebi);
}

TEST_F(Memory, JointsThatMultiply) {
    constexpr std::size_t vertices = 50'000;
    GltfBuilder builder = strip(vertices);
    const int zeros = builder.add_accessor(std::vector<std::uint8_t>(4 * vertices), "VEC4");
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    for (int set = 0; set < 999; ++set)
        attributes["JOINTS_" + std::to_string(set)] = attributes["WEIGHTS_" + std::to_string(set)] = zeros;
    builder.json["skins"] = {{{"joints", {0}}}};
    builder.json["nodes"][0]["skin"] = 0;
    expect("a.glb", builder.glb(), "has 999 JOINTS_n, more than the limit of 8", 32 * mebi);
}

TEST_F(Memory, TextsOfPolygons) {
    constexpr std::size_t many = 400'000;
    expect("a.obj", corners + repeated("f 1 2 3\n", many), "400000 triangles", 64 * 8 * many);
    expect("b.obj", corners + "f" + repeated(" 1 2 3", many), "triangles", 72 * 6 * many);
    expect("c.obj", corners + repeated("v 0 0 0\n", many) + "f 1 2 3\n", "1 triangles", 32 * 8 * many);
    expect("d.ply",
           "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n"
           "property uchar z\nelement face 400000\nproperty list uchar uchar vertex_indices\nend_header\n" +
               std::string("\0\0\0\1\0\0\0\1\0", 9) + repeated(std::string("\3\0\1\2", 4), many),
           "400000 triangles", 96 * 4 * many);
}

TEST_F(Memory, MaterialLibraries) {
    scratch_.write("a.mtl", repeated("newmtl m\n", 2'000'000));
    expect("a.obj", "mtllib a.mtl\n" + corners + "f 1 2 3\n",
           "its material libraries have more than 65536 materials", 4 * 18 * mebi);
    scratch_.write("b.mtl", repeated("newmtl m\n", 60'000));
    expect("b.obj", repeated("mtllib b.mtl\n", 100'000) + corners + "f 1 2 3\n", "1 triangles", 64 * mebi);
    std::string missing;
    for (int i = 0; i < 20'000; ++i) missing += "mtllib " + std::to_string(i) + "\n";
    expect("c.obj", missing + corners + "f 1 2 3\n", "refers to more than 16384 files", 32 * mebi);
}

// A quad with this picture on it.
std::string quad_with(const std::string& picture) {
    GltfBuilder builder = triangle();
    const int view = builder.add_view(picture);
    const int uv = builder.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = uv;
    primitive["material"] = 0;
    builder.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    return builder.glb();
}

TEST_F(Memory, TextOfPictures) {
    const std::string text = compressed_run('a', 7'000'000);
    const std::string profile = png_chunk("iCCP", std::string("k\0\0", 3) + text);
    const std::string comment = png_chunk("zTXt", std::string("k\0\0", 3) + text);
    const std::string other = png_chunk("iTXt", std::string("k\0\1\0\0\0", 6) + text);
    expect("a.glb", quad_with(black_png(8, 8, profile + repeated(comment, 20) + repeated(other, 20))),
           "1 triangles", 32 * mebi);
}

TEST_F(Memory, Pictures) {
    // 4096 x 4096 pixels and their smaller levels take 85 MiB.
    expect("a.glb", quad_with(black_png(4096, 4096)), "1 triangles", 160 * mebi);
    expect("b.glb", quad_with(black_png(32768, 32768)), "more than the limit of 268435456", 32 * mebi);
    scratch_.write_tga("wide.tga", 60'000, std::vector<std::array<std::uint8_t, 4>>(60'000));
    scratch_.write_tga("high.tga", 1, std::vector<std::array<std::uint8_t, 4>>(60'000));
    scratch_.write("a.mtl", "newmtl m\nmap_Kd wide.tga\nmap_d high.tga\n");
    expect("a.obj", "mtllib a.mtl\n" + corners + "usemtl m\nf 1 2 3\n",
           "material 'm' of a.mtl: wide.tga + high.tga: cannot be decoded as an image: it makes a texture of "
           "60000 x 60000 pixels",
           32 * mebi);
}

} // namespace
} // namespace spa::test
