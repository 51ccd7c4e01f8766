// SPDX-License-Identifier: Apache-2.0
// Reads an asset file into a Model, or into a Scene with nodes, cameras and lights. Safe for untrusted input:
// limits before allocation, no crash, no hang, no silent loss.
#pragma once

#include "../../libspa/mesh/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spa::import {

struct Limits {
    std::uint64_t file_bytes = 4ULL << 30;     // of any one file read
    std::uint64_t total_bytes = 8ULL << 30;    // of all files read, each as often as it is
    std::uint64_t model_bytes = 8ULL << 30;    // of the model in memory, textures with all mips included
    std::uint64_t vertices = 1ULL << 28;       // in the flattened model
    std::uint64_t triangles = 1ULL << 28;      // in the flattened model
    std::uint64_t texture_pixels = 1ULL << 28; // of one image
    std::uint32_t node_depth = 256;            // of a node hierarchy
    // Whether references may lead out of the asset's folder through symbolic links; if not, such a reference
    // is Error(invalid_data). The asset itself may be a link: its folder is that of the link.
    bool follow_links = false;
};

// What the file system says of a file; of equal states a file is taken as unchanged.
struct FileState {
    std::uint64_t device = 0, inode = 0, size = 0;
    std::int64_t mtime_ns = 0, ctime_ns = 0; // of the content's and the inode's last change, since 1970

    bool operator==(const FileState&) const = default;
};

// Of the file of this name, symbolic links followed; nothing if there is no regular file.
std::optional<FileState> file_state(const std::filesystem::path& path);

// One file that the model was made from; the asset itself first, then what it references, in the order of
// the first reference.
struct SourceFile {
    std::string name; // as referenced, relative to the asset's folder; the asset: its file name
    std::uint64_t bytes = 0;
    std::uint64_t xxh3 = 0; // XXH3-64 of the content
    FileState state;        // before and after it was read
};

struct Report {
    std::string format; // "glTF", "GLB", "OBJ", "PLY", "STL" or "OFF"
    std::vector<SourceFile> files;
    // Files that were looked for and absent, without an error: with one of them the result would be another.
    // Names as in SourceFile, each once. Where OBJ and MTL take a file whose name differs in the case of
    // letters (find_in_any_case), the name that they say is among them too.
    std::vector<std::string> missing;
    std::vector<std::string> warnings;    // full sentences; each distinct one once, in order
    std::uint64_t dropped_degenerate = 0; // triangles with two equal corners in the index buffer or no area
    std::uint64_t dropped_non_finite = 0; // triangles with a NaN or infinite corner
    std::uint64_t ignored_primitives = 0; // points and lines
    bool computed_normals = false;        // at least one mesh came without normals
};

struct Result {
    Model model; // at least one triangle; normals always present
    Report report;
};

// Reads a model; the format is recognised by content first, then by extension (.gltf .glb .obj .ply .stl
// .off, any case). Throws Error: input_output if a file cannot be opened or read or changes meanwhile,
// invalid_data if the content is wrong or holds nothing to bake, unsupported for a valid file that needs what
// we do not read (an unknown required extension: by name). Every message starts with the path. Deterministic.
// Time and memory linear in the size of the files and of the flattened model.
Result read_model(const std::filesystem::path& path, const Limits& limits = {});

// The file that OBJ and MTL files take where there is none of this name: one whose name differs in the case
// of letters (A to Z), the first in the order of bytes if there are several. name: relative to the folder,
// with '/' between its parts. Returns the name as it is on disk, or nothing.
std::optional<std::string> find_in_any_case(const std::filesystem::path& folder, std::string_view name);

struct SceneResult {
    Scene scene; // scene.model and the warnings about it are those of read_model
    Report report;
};

// What of a scene is read beside what it always has.
struct SceneOptions {
    // Scene::rig: the bones and weights of the model, which is then in its rest pose as always, and the
    // animations of glTF. The morph targets of the rig have their default weights.
    bool rig = false;
};

// Reads a scene: as read_model does, and which node every triangle belongs to, and
// - of glTF the nodes of the scene (a node with several parents once below each; EXT_mesh_gpu_instancing
// makes
//   the node a nameless one and each instance a node of its name below), the perspective cameras, and the
//   lights of KHR_lights_punctual. A camera or light without a name has its node's. Skinned meshes stand
//   where their joints are, not where their node is. Orthographic cameras and the range of lights are left
//   out, with warnings. All nodes have finite transforms; no camera is flat.
// - of OBJ a node for each object (o) and, below it, for each group (g) that has faces, not moved; faces
// before
//   any belong to a node named after the file, without its extension.
// - of all others that node alone.
// Joints that the scene does not list come last, as nodes, if a rig is wanted. An animation that moves a node
// which stands at several places moves all of them; what moves none of the scene's nodes, the weights of
// morph targets and what extensions move are left out, the latter two with warnings.
// Throws Error(invalid_data) too where a camera, a light or, of a rig, an animation breaks the rules of glTF
// (scene.h and rig.h name the ranges), and for more than 2^20 nodes or 64 MiB of names.
SceneResult read_scene(const std::filesystem::path& path, const Limits& limits = {},
                       const SceneOptions& options = {});

} // namespace spa::import
