// SPDX-License-Identifier: Apache-2.0
// import_seeds FOLDER [ASSETS]: writes the seed corpora of the importers' fuzzers, a folder a format: small
// assets made here and, where the folder of the test assets is given and there, its small files.
#include "../import_gltf/compressed_builder.h"
#include "../import_gltf/scene_builder.h"

#include <array>
#include <fstream>
#include <iostream>
#include <map>

namespace {

namespace fs = std::filesystem;
using namespace spa::test;

void save(const fs::path& path, std::string_view bytes) {
    fs::create_directories(path.parent_path());
    std::ofstream stream(path, std::ios::binary);
    stream.write(bytes.data(), std::streamsize(bytes.size()));
    if (!stream.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

GltfBuilder textured() {
    GltfBuilder builder = triangle();
    builder.json["images"] = {{{"uri", "a.png"}}, {{"uri", "a.tga"}}};
    builder.json["samplers"] = {{{"wrapS", 33071}}};
    builder.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    builder.json["materials"] = {
        {{"alphaMode", "BLEND"},
         {"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0},
             {"extensions", {{"KHR_texture_transform", {{"scale", {2, 1}}, {"rotation", 1}}}}}}}}}}};
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] =
        builder.add_accessor<std::uint8_t>({0, 0, 255, 0, 0, 255}, "VEC2", true);
    primitive["attributes"]["COLOR_0"] = builder.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    return builder;
}

GltfBuilder posed() {
    GltfBuilder builder = triangle();
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["JOINTS_0"] =
        builder.add_accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    primitive["attributes"]["WEIGHTS_0"] =
        builder.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, .5F, .5F, 0, 0}, "VEC4");
    primitive["targets"] = {{{"POSITION", builder.add_accessor<float>({0, 0, 1, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
    builder.json["meshes"][0]["weights"] = {0.5};
    const std::vector<float> unit{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::vector<float> binds = unit;
    binds.insert(binds.end(), unit.begin(), unit.end());
    builder.json["skins"] = {
        {{"joints", {1, 2}}, {"inverseBindMatrices", builder.add_accessor(binds, "MAT4")}}};
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"].push_back(
        {{"translation", {0, 0, 1}}, {"rotation", {0, 0, 1, 0}}, {"children", {2}}});
    builder.json["nodes"].push_back({{"matrix", unit}});
    builder.json["scenes"][0]["nodes"].push_back(1);
    builder.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}}}},
         {"samplers",
          {{{"input", builder.add_accessor<float>({0, 1}, "SCALAR")},
            {"output", builder.add_accessor<float>({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4")}}}}}};
    return builder;
}

GltfBuilder instanced() {
    GltfBuilder builder = triangle();
    const int places = builder.add_accessor<float>({0, 0, 0, 2, 0, 0}, "VEC3");
    Json& node = builder.json["nodes"][0];
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    const int indices = builder.add_view({"\0\0\1\0", 4});
    const int values = builder.add_view(
        std::string_view("\0\0\x80\x3F\0\0\x80\x3F\0\0\x80\x3F\0\0\x80\x3F\0\0\x80\x3F\0\0\x80\x3F", 24));
    builder.json["accessors"][0]["sparse"] = {{"count", 2},
                                              {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                              {"values", {{"bufferView", values}}}};
    return builder;
}

std::map<std::string, GltfBuilder> documents() {
    GltfBuilder shared = triangle();
    shared.json["nodes"].push_back({{"children", {0}}, {"scale", {1, -1, 1}}});
    shared.json["nodes"].push_back({{"children", {0, 1}}});
    shared.json["scenes"][0]["nodes"] = {2};
    GltfBuilder external = triangle();
    external.json["buffers"] = {{{"uri", "a.bin"}, {"byteLength", 72}}};
    return {
        {"triangle", triangle()},
        {"textured", textured()},
        {"posed", posed()},
        {"instanced", instanced()},
        {"shared", shared},
        {"external", external},
        {"camera", seen_triangle({{"yfov", 1}, {"znear", 0.1}})},
        {"lamp", lit_triangle({{"type", "spot"}, {"spot", {{"outerConeAngle", 1}}}, {"color", {1, 1, 0}}})},
        {"meshopt_triangles", with_fallback_buffer(meshopt_quad(true))},
        {"meshopt_indices", with_fallback_buffer(meshopt_quad(false))},
        {"draco_sequential", draco_grid(2, true)},
        {"draco", draco_grid(3, false)}};
}

void save_meshes(const fs::path& folder) {
    const std::string mtl{"newmtl m\nKd 1 .5 0\nd .5\nmap_Kd -s 2 2 -clamp on a.png\nmap_d a.tga\n"};
    save(folder / "obj/quad.obj", "mtllib a.mtl\no part\ng group\nusemtl m\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\n"
                                  "v 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 \\\n3 -1\nl 1 2\n" +
                                      std::string(1, '\0') + mtl);
    const std::string header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                               "element face 1\nproperty list uchar int vertex_indices\n"
                               "property list uchar float texcoord\nend_header\n";
    save(folder / "ply/ascii.ply", "ply\nformat ascii 1.0\ncomment TextureFile a.png\n" + header +
                                       "0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2 6 0 0 1 0 0 1\n");
    const std::string vertex("\0\0\x80\x3F\0\0\0\0\0\0\0\0\1\2\3", 15);
    save(folder / "ply/binary.ply", "ply\nformat binary_little_endian 1.0\n" + header +
                                        std::string(12, '\0') + "\1\2\3" + vertex + vertex.substr(4, 4) +
                                        vertex.substr(0, 4) + vertex.substr(8) +
                                        std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0\0", 14));
    save(folder / "stl/ascii.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                   "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n");
    std::string binary(80, ' ');
    binary += std::string("\1\0\0\0", 4) + std::string(12, '\0') + std::string(12, '\0') +
              vertex.substr(0, 12) + vertex.substr(4, 4) + vertex.substr(0, 4) + vertex.substr(4, 4) +
              std::string(2, '\0');
    save(folder / "stl/binary.stl", binary);
    save(folder / "off/plain.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n");
    save(folder / "off/all.off", "STCNOFF # all\n3 1 0\n0 0 0 0 0 1 1 0 0 1 0 0\n1 0 0 0 0 1 0 1 0 1 1 0\n"
                                 "0 1 0 0 0 1 0 0 1 .5 0 1\n3 0 1 2\n");
}

// Files of the test assets that are small enough to be mutated quickly.
void copy_assets(const fs::path& assets, const fs::path& folder) {
    constexpr std::uintmax_t most_bytes = 16384;
    const std::map<std::string, std::string> formats{{".gltf", "gltf"}, {".glb", "gltf"}, {".obj", "obj"},
                                                     {".ply", "ply"},   {".stl", "stl"},  {".off", "off"}};
    std::size_t number = 0;
    for (const auto& entry : fs::recursive_directory_iterator(assets)) {
        if (!entry.is_regular_file() || entry.file_size() > most_bytes) continue;
        std::ifstream stream(entry.path(), std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        std::string extension = entry.path().extension().string();
        for (char& c : extension) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
        const std::string name = "asset" + std::to_string(number++) + extension;
        if (const auto format = formats.find(extension); format != formats.end())
            save(folder / format->second / name, bytes);
        else if (extension == ".png" || extension == ".jpg")
            save(folder / "picture" / name, std::string(1, number % 2 == 0 ? '\0' : '\2') + bytes);
    }
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2) return 1;
    const fs::path folder = argv[1];
    for (const auto& [name, builder] : documents()) {
        save(folder / "gltf" / (name + ".gltf"), builder.text());
        save(folder / "gltf" / (name + ".glb"), builder.glb());
    }
    save_meshes(folder);
    const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x28\1\2\3\4", 22);
    save(folder / "picture/a.tga", "\1" + tga);
    save(folder / "picture/run.tga", "\1" + tga.substr(0, 2) + "\x0A" + tga.substr(3, 15) + "\x80\1\2\3\4");
    if (argc > 2 && fs::is_directory(argv[2])) copy_assets(argv[2], folder);
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
}
