// SPDX-License-Identifier: Apache-2.0
// Reads a picture file as linear light, to compare it with another.
#pragma once

#include "../../libspa/core/vector.h"
#include "import.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spa::import {

// Linear RGB, row by row from the top.
struct PictureLayer {
    std::string name; // of an EXR layer, such as "indirect"; empty: the picture itself
    std::vector<Vec3f> pixels;
};

struct LinearPicture {
    std::uint32_t width = 0, height = 0;
    std::vector<PictureLayer> layers; // the picture itself first

    // Null if there is none.
    [[nodiscard]] const PictureLayer* find(std::string_view name) const;
};

// Reads the channels R, G and B, or the one channel of a grey picture, and those of `layers` that the file
// has ("indirect": the channels indirect.R, indirect.G and indirect.B). PNG, JPEG, WebP, BMP, TGA, TIFF
// or OpenEXR: whole numbers are taken as sRGB codes, floats as linear light. Alpha is not looked at, and of
// several pictures in a file the first is taken. Values are as they are stored, NaN and infinity included.
// Safe for untrusted input: sizes are checked before pixels are allocated. Throws Error: input_output if the
// file cannot be read, invalid_data if it is no picture, has no colour or more than limits.texture_pixels
// pixels, unsupported for another format or one that OpenImageIO was built without. Every message starts with
// the path. O(pixels * (1 + layers)) in memory.
LinearPicture read_picture(const std::filesystem::path& path, std::span<const std::string_view> layers = {},
                           const Limits& limits = {});

} // namespace spa::import
