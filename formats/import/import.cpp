// SPDX-License-Identifier: Apache-2.0
// Which reader a file is for: its first bytes decide, the extension only where they do not.
#include "import.h"

#include "../../libspa/core/error.h"
#include "open_file.h"
#include "readers.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

namespace spa::import {
namespace {

using Reader = Result (*)(const Asset&, const Limits&);

constexpr std::size_t head_bytes = 512; // tell the formats apart

constexpr std::size_t binary_stl_header = 84; // 80 bytes of text and the number of triangles
constexpr std::size_t binary_stl_triangle = 50;

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

// The size that a binary STL of this head would have; 0 if it is none.
std::uint64_t binary_stl_size(std::string_view head) {
    if (head.size() < binary_stl_header) return 0;
    std::uint32_t triangles = 0;
    std::memcpy(&triangles, head.data() + 80, sizeof triangles);
    return binary_stl_header + std::uint64_t{binary_stl_triangle} * triangles;
}

// The first word: up to white space.
std::string_view first_word(std::string_view text) {
    const auto end = std::find_if(text.begin(), text.end(), is_space);
    return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

Reader reader_by_content(std::string_view head, std::uint64_t file_size) {
    if (head.substr(0, 4) == "glTF") return read_gltf;
    if (binary_stl_size(head) == file_size && file_size > binary_stl_header) return read_stl;
    if (head.substr(0, 3) == "\xEF\xBB\xBF") head.remove_prefix(3);
    while (!head.empty() && is_space(head.front())) head.remove_prefix(1);
    if (head.empty()) return nullptr;
    if (head.front() == '{') return read_gltf;
    const std::string_view word = first_word(head);
    if (word == "ply") return read_ply;
    if (word == "solid") return read_stl;
    // Geomview's prefixes in their order: texture, colour, normal, fourth coordinate, dimension.
    constexpr std::string_view prefixes[] = {"ST", "C", "N", "4", "n"};
    std::string_view keyword = word;
    for (const std::string_view prefix : prefixes)
        if (keyword.substr(0, prefix.size()) == prefix) keyword.remove_prefix(prefix.size());
    if (keyword == "OFF") return read_off;
    return nullptr;
}

Reader reader_by_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    struct Row {
        std::string_view extension;
        Reader reader;
    };
    constexpr Row rows[] = {{".gltf", read_gltf}, {".glb", read_gltf}, {".obj", read_obj},
                            {".ply", read_ply},   {".stl", read_stl},  {".off", read_off}};
    for (const Row& row : rows)
        if (row.extension == extension) return row.reader;
    return nullptr;
}

Reader find_reader(const std::filesystem::path& path, std::span<const std::byte> head, std::uint64_t size) {
    const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    Reader reader = reader_by_content(text, size);
    if (reader == nullptr) reader = reader_by_extension(path);
    if (reader == nullptr)
        throw Error(ExitCode::invalid_data, path.string() + ": neither the content nor the extension is that "
                                                            "of glTF, GLB, OBJ, PLY, STL or OFF");
    return reader;
}

Reader find_reader(const Asset& asset) {
    const std::span<const std::byte> bytes = asset.file.bytes;
    return find_reader(asset.path, bytes.first(std::min(bytes.size(), head_bytes)), bytes.size());
}

// The folder is looked up first: were the asset's folder exchanged for a link meanwhile, its references would
// lead to where no asset was named.
Asset open_asset(const std::filesystem::path& path, const Limits& limits) {
    Asset asset{path, {}, real_folder(path.parent_path())};
    // What is no asset is not read in full.
    const FileContent head = read_file(path, limits, head_bytes);
    (void)find_reader(path, head.bytes, head.state.size);
    asset.file = read_file(path, limits);
    return asset;
}

// Of nodes that stand still: every vertex follows the node of its first triangle.
void add_rigid_rig(const Asset& asset, const Limits& limits, Scene& scene) {
    constexpr std::uint64_t rigged_vertex_bytes = vertex_bytes + 2 * sizeof(Vec3f) + sizeof(Influence) + 4;
    if (scene.model.positions.size() * rigged_vertex_bytes + scene.model.triangles.size() * triangle_bytes >
        limits.model_bytes)
        throw Error(ExitCode::invalid_data,
                    asset.path.string() + ": its rig makes it larger than the limit of " +
                        std::to_string(limits.model_bytes) + " bytes; simplify the mesh");
    Rig& rig = scene.rig;
    rig.positions = scene.model.positions;
    rig.normals = scene.model.normals;
    rig.influences.resize(rig.positions.size(), {no_index, 1});
    for (std::uint32_t v = 0; v <= rig.positions.size(); ++v) rig.first.push_back(v);
    std::vector<std::uint32_t> bones(scene.nodes.size(), no_index);
    for (std::size_t t = 0; t < scene.model.triangles.size(); ++t)
        for (const std::uint32_t vertex : scene.model.triangles[t].vertex) {
            if (rig.influences[vertex].bone != no_index) continue;
            const std::uint32_t node = scene.triangle_nodes[t];
            if (bones[node] == no_index) {
                bones[node] = static_cast<std::uint32_t>(rig.bones.size());
                rig.bones.push_back({node, no_index, 0, {}});
            }
            rig.influences[vertex].bone = bones[node];
        }
}

} // namespace

Result read_asset(const Asset& asset, const Limits& limits) { return find_reader(asset)(asset, limits); }

SceneResult read_asset_scene(const Asset& asset, const Limits& limits, const SceneOptions& options) {
    const Reader reader = find_reader(asset);
    if (reader == read_gltf) return read_gltf_scene(asset, limits, options);
    SceneResult result;
    if (reader == read_obj) {
        result = read_obj_scene(asset, limits);
    } else {
        Result read = reader(asset, limits);
        result.report = std::move(read.report);
        result.scene.model = std::move(read.model);
        result.scene.nodes.push_back({asset.path.stem().string(), no_index, {}});
        result.scene.triangle_nodes.assign(result.scene.model.triangles.size(), 0);
    }
    for (std::uint32_t i = 0; i < result.scene.nodes.size(); ++i) result.scene.nodes[i].source = i;
    if (options.rig) add_rigid_rig(asset, limits, result.scene);
    return result;
}

Result read_model(const std::filesystem::path& path, const Limits& limits) {
    return read_asset(open_asset(path, limits), limits);
}

SceneResult read_scene(const std::filesystem::path& path, const Limits& limits, const SceneOptions& options) {
    return read_asset_scene(open_asset(path, limits), limits, options);
}

} // namespace spa::import
