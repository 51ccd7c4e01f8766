// SPDX-License-Identifier: Apache-2.0
// Reads an asset file into a Model. Safe for untrusted input: limits before allocation, no crash, no hang,
// no silent loss.
#pragma once

#include "../../libspa/mesh/model.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spa::import {

struct Limits {
    std::uint64_t file_bytes = 4ULL << 30;     // of any one file read
    std::uint64_t vertices = 1ULL << 28;       // in the flattened model
    std::uint64_t triangles = 1ULL << 28;      // in the flattened model
    std::uint64_t texture_pixels = 1ULL << 28; // of one image
    std::uint32_t node_depth = 256;            // of a node hierarchy
};

// One file that the model was made from; the asset itself first, then what it references, in the order of
// the first reference.
struct SourceFile {
    std::string name; // as referenced, relative to the asset's folder; the asset: its file name
    std::uint64_t bytes = 0;
    std::uint64_t xxh3 = 0; // XXH3-64 of the content
};

struct Report {
    std::string format; // "glTF", "GLB", "OBJ", "PLY", "STL" or "OFF"
    std::vector<SourceFile> files;
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
// .off, any case). Throws Error: input_output if the file cannot be opened or read, invalid_data if the
// content is wrong or holds nothing to bake, unsupported for a valid file that needs what we do not read (an
// unknown required extension: by name). Every message starts with the path.
// Deterministic. Time and memory linear in the size of the files and of the flattened model.
Result read_model(const std::filesystem::path& path, const Limits& limits = {});

} // namespace spa::import
