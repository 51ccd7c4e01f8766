// SPDX-License-Identifier: Apache-2.0
// Decodes a picture in memory into a Texture.
#pragma once

#include "import.h"

#include <cstddef>
#include <span>
#include <string>

namespace spa::import {

// Decodes PNG, JPEG and whatever else OpenImageIO reads from memory (TGA, BMP, TIFF, WebP, ...): any bit
// depth, grey, palette, transparency chunk, CMYK; the result is sRGB with straight alpha and all its mips.
// `name` becomes Texture::name; its extension is a hint for formats that have no signature (TGA). Throws
// Error(invalid_data) for what cannot be decoded or has more than limits.texture_pixels pixels (checked
// before pixels are allocated), Error(unsupported) for a format that OpenImageIO was built without. The
// messages start with `name`.
Texture read_texture(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);

} // namespace spa::import
