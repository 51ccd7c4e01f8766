// SPDX-License-Identifier: Apache-2.0
// Decodes a picture in memory into a Texture.
#pragma once

#include "import.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace spa::import {

// Decodes PNG, JPEG, WebP, BMP, TGA and TIFF: any bit depth, grey, palette, transparency chunk, CMYK; the
// result is sRGB with straight alpha and all its mips.
// `name` becomes Texture::name; its extension is a hint for formats that have no signature (TGA). Throws
// Error(invalid_data) for what cannot be decoded or has more than limits.texture_pixels pixels (checked
// before pixels are allocated), Error(unsupported) for another format or one that OpenImageIO was built
// without. The messages start with `name`.
Texture read_texture(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);

// What the textures of one model may take, limits.model_bytes in all: many that are fine alone can be too
// many.
class TextureBudget {
public:
    explicit TextureBudget(const Limits& limits) : limits_(limits) {}

    // As read_texture; the texture is one of the model's. Throws Error(invalid_data) too if it has more
    // pixels than are left.
    Texture decode(std::span<const std::byte> bytes, const std::string& name);
    // For a texture that is made of others and not kept itself: as read_texture within what is left.
    [[nodiscard]] Texture decode_part(std::span<const std::byte> bytes, const std::string& name) const;

    // Before a texture of this size is made. Throws as decode does.
    void claim(std::uint32_t width, std::uint32_t height, const std::string& name);
    void spend(std::uint64_t bytes) { spent_ += bytes; }

private:
    [[nodiscard]] Limits left() const;

    const Limits& limits_;
    std::uint64_t spent_ = 0;
};

} // namespace spa::import
