// SPDX-License-Identifier: Apache-2.0
// One reader per format behind read_model. Each reads the file itself, records in Report::files what it read
// and throws Error as import.h says.
#pragma once

#include "import.h"

#include <filesystem>

namespace spa::import {

Result read_gltf(const std::filesystem::path& path, const Limits& limits); // glTF 2.0 JSON and GLB
Result read_obj(const std::filesystem::path& path, const Limits& limits);
Result read_ply(const std::filesystem::path& path, const Limits& limits);
Result read_stl(const std::filesystem::path& path, const Limits& limits);
Result read_off(const std::filesystem::path& path, const Limits& limits);

} // namespace spa::import
