// SPDX-License-Identifier: Apache-2.0
// One reader per format behind read_model and read_scene. Each reads the files that the asset refers to,
// records the asset and them in Report::files and throws Error as import.h says.
#pragma once

#include "import.h"
#include "source_file.h"

#include <cstddef>
#include <cstdint>

namespace spa::import {

// By the reader that the first bytes ask for or, where they do not say, the extension.
Result read_asset(const Asset& asset, const Limits& limits);
SceneResult read_asset_scene(const Asset& asset, const Limits& limits, const SceneOptions& options);

Result read_gltf(const Asset& asset, const Limits& limits); // glTF 2.0 JSON and GLB
Result read_obj(const Asset& asset, const Limits& limits);
Result read_ply(const Asset& asset, const Limits& limits);
Result read_stl(const Asset& asset, const Limits& limits);
Result read_off(const Asset& asset, const Limits& limits);

// What beside the model has nodes.
SceneResult read_gltf_scene(const Asset& asset, const Limits& limits, const SceneOptions& options);
SceneResult read_obj_scene(const Asset& asset, const Limits& limits);

// What a vertex and a triangle of a model take at most, by which limits.model_bytes is counted: position,
// normal, uv and colour; indices, material and node.
inline constexpr std::uint64_t vertex_bytes = 48, triangle_bytes = 20;

// What shared children, instances, objects and groups may make of a file.
inline constexpr std::size_t max_nodes = std::size_t{1} << 20U;

} // namespace spa::import
