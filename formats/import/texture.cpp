// SPDX-License-Identifier: Apache-2.0
#include "texture.h"

#include "../../libspa/core/element_format.h"
#include "../../libspa/core/error.h"
#include "image_input.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spa::import {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

// The reader wrote `channels` values at the start of every pixel: 1 grey, 2 grey and alpha, 3 colour.
void spread_channels(std::vector<Pixel>& pixels, int channels) {
    if (channels == 3)
        for (Pixel& pixel : pixels) pixel[3] = 255;
    if (channels == 1)
        for (Pixel& pixel : pixels) pixel = {pixel[0], pixel[0], pixel[0], 255};
    if (channels == 2)
        for (Pixel& pixel : pixels) pixel = {pixel[0], pixel[0], pixel[0], pixel[1]};
}

std::vector<Pixel> read_pixels(ImageInput& image, const std::string& name) {
    OIIO::ImageInput& input = image.reader();
    const OIIO::ImageSpec& spec = image.spec();
    const auto width = static_cast<std::size_t>(spec.width), height = static_cast<std::size_t>(spec.height);
    const int channels = std::min(spec.nchannels, 4);
    std::vector<Pixel> pixels(width * height);
    if (!image.linear()) {
        if (!input.read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, pixels.data(), sizeof(Pixel)))
            fail_image(name, input.geterror());
    } else {
        std::vector<std::array<float, 4>> values(pixels.size());
        if (!input.read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data(), sizeof(values[0])))
            fail_image(name, input.geterror());
        const bool has_alpha = channels == 2 || channels == 4;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
                const bool alpha = has_alpha && c + 1 == static_cast<std::size_t>(channels);
                const float value = std::clamp(values[i][c], 0.0F, 1.0F);
                pixels[i][c] =
                    alpha ? static_cast<std::uint8_t>(std::lround(value * 255.0F)) : linear_to_srgb(value);
            }
    }
    spread_channels(pixels, channels);
    return pixels;
}

} // namespace

Texture read_texture(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    Texture texture;
    texture.name = name;
    try {
        ImageInput input(bytes, name, ImageUse::texture, limits);
        Image image;
        image.width = static_cast<std::uint32_t>(input.spec().width);
        image.height = static_cast<std::uint32_t>(input.spec().height);
        image.pixels = read_pixels(input, name);
        texture.mips.push_back(std::move(image));
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail_image(name, error.what());
    }
    build_mips(texture);
    return texture;
}

namespace {

// All levels, each a quarter of the one before; a row or column halves.
std::uint64_t bytes_of(std::uint64_t width, std::uint64_t height) {
    const std::uint64_t pixels = width * height;
    return sizeof(Pixel) * (width == 1 || height == 1 ? 2 * pixels : pixels + pixels / 3 + 1);
}

} // namespace

Limits TextureBudget::left() const {
    Limits limits = limits_;
    const std::uint64_t bytes = limits.model_bytes - std::min(spent_, limits.model_bytes);
    limits.texture_pixels = std::min(limits.texture_pixels, bytes / sizeof(Pixel) / 4 * 3);
    return limits;
}

Texture TextureBudget::decode_part(std::span<const std::byte> bytes, const std::string& name) const {
    return read_texture(bytes, name, left());
}

Texture TextureBudget::decode(std::span<const std::byte> bytes, const std::string& name) {
    Texture texture = decode_part(bytes, name);
    spend(bytes_of(texture.mips[0].width, texture.mips[0].height));
    return texture;
}

void TextureBudget::claim(std::uint32_t width, std::uint32_t height, const std::string& name) {
    const std::uint64_t most = left().texture_pixels;
    if (std::uint64_t{width} * height > most)
        fail_image(name, "it makes a texture of " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels, more than the limit of " + std::to_string(most));
    spend(bytes_of(width, height));
}

} // namespace spa::import
