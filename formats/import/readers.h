// SPDX-License-Identifier: Apache-2.0
// One reader per format behind read_model and read_scene. Each reads the file itself, records in
// Report::files what it read and throws Error as import.h says.
#pragma once

#include "import.h"

#include <cstddef>
#include <filesystem>

namespace spa::import {

Result read_gltf(const std::filesystem::path& path, const Limits& limits); // glTF 2.0 JSON and GLB
Result read_obj(const std::filesystem::path& path, const Limits& limits);
Result read_ply(const std::filesystem::path& path, const Limits& limits);
Result read_stl(const std::filesystem::path& path, const Limits& limits);
Result read_off(const std::filesystem::path& path, const Limits& limits);

// What beside the model has nodes.
SceneResult read_gltf_scene(const std::filesystem::path& path, const Limits& limits);
SceneResult read_obj_scene(const std::filesystem::path& path, const Limits& limits);

// What shared children, instances, objects and groups may make of a file.
inline constexpr std::size_t max_nodes = std::size_t{1} << 20U;

} // namespace spa::import
