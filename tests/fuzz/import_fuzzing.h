// SPDX-License-Identifier: Apache-2.0
// What the fuzzers of the importers do with an input. They abort if a promise of formats/import is broken.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace spa::test {

// `name` of the asset: "a.gltf", "a.obj", "a.ply", "a.stl" or "a.off". Reads a model and, where there is more
// to it, a scene. Files that the asset refers to: "a.bin", "a.png", "a.tga", and of an OBJ "a.mtl", which is
// what follows the first zero byte of the input. Numbers of bytes and vertices are limited to a few ten
// thousand.
void fuzz_asset(std::string_view name, std::span<const std::byte> input);

// The first byte chooses the way in and the name, the rest is a picture.
void fuzz_picture(std::span<const std::byte> input);

} // namespace spa::test
