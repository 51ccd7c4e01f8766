// SPDX-License-Identifier: Apache-2.0
// A rendered frame as files: one EXR with layers, or PNG pictures.
#pragma once

#include "picture.h"

#include "../libspa/render/render.h"

#include <filesystem>
#include <string>
#include <vector>

namespace spa::tools {

// Direct and indirect light together.
std::vector<Vec3f> beauty(const render::Frame& frame);

// 32-bit float: R, G, B; the layers direct, indirect and albedo (R, G, B), normal (X, Y, Z), depth (Z); and
// the channel kind.
std::vector<std::byte> encode_frame(const render::Frame& frame);

// What the frame holds beside the picture itself, for people, in the order of aov_names. Nothing that a ray
// met: black.
inline constexpr const char* aov_names[] = {"direct", "indirect", "normal", "depth", "kind"};
struct NamedPicture {
    const char* name;
    Picture picture;
};
std::vector<NamedPicture> aov_pictures(const render::Frame& frame, double exposure);

// beside("out.png", "depth"): "out.depth.png".
std::filesystem::path beside(const std::filesystem::path& path, const std::string& name);

} // namespace spa::tools
