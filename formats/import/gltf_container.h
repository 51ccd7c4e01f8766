// SPDX-License-Identifier: Apache-2.0
// The outer layer of a glTF asset: a JSON text, or a GLB with a JSON and a BIN chunk.
#pragma once

#include "gltf_context.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace spa::import::gltf {

struct Container {
    bool binary = false;                           // GLB
    std::string_view json;                         // views into the file
    std::optional<std::span<const std::byte>> bin; // the BIN chunk
};

// Splits the bytes of a .gltf or .glb file. Throws Error(invalid_data) for a damaged GLB and for JSON that is
// nested so deeply or has so many values that it is an attack.
Container split_container(std::span<const std::byte> file, const Context& context);

} // namespace spa::import::gltf
