// SPDX-License-Identifier: Apache-2.0
#include "texture.h"

#include "../../libspa/core/element_format.h"
#include "../../libspa/core/error.h"
#include "image_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace spa::import {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

[[noreturn]] void fail(const std::string& name, const std::string& why) {
    throw Error(ExitCode::invalid_data, name + ": cannot be decoded as an image: " + why);
}

// OpenImageIO's name of the reader. The content decides; the extension only for TGA, which has no signature.
std::string reader_name(std::span<const std::byte> bytes, const std::string& name) {
    switch (image_kind(bytes)) {
    case ImageKind::png: return "png";
    case ImageKind::jpeg: return "jpeg";
    case ImageKind::gif: return "gif";
    case ImageKind::bmp: return "bmp";
    case ImageKind::tiff: return "tiff";
    case ImageKind::webp: return "webp";
    case ImageKind::psd: return "psd";
    case ImageKind::dds: return "dds";
    case ImageKind::hdr: return "hdr";
    case ImageKind::exr: return "openexr";
    case ImageKind::ktx:
        throw Error(ExitCode::unsupported, name + ": is a KTX texture, which is not read; use PNG or JPEG");
    case ImageKind::unknown: break;
    }
    std::string extension = std::filesystem::path(name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".tga") return "targa";
    fail(name, bytes.empty() ? "it is empty" : "its first bytes are those of no known image format");
}

void check_size(const std::string& name, std::uint64_t width, std::uint64_t height, const Limits& limits) {
    if (width == 0 || height == 0) fail(name, "it claims no pixels");
    if (width > limits.texture_pixels / height)
        fail(name, "it claims " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels, more than the limit of " + std::to_string(limits.texture_pixels));
}

// Refuses what claims more than its bytes can hold. Deflate makes at most 1032 bytes of one (RFC 1951: 258
// bytes of one 2-bit code). A JPEG block of 64 pixels takes at least half a bit in any mode that is in use.
void check_claim(const std::string& name, std::span<const std::byte> bytes, const Limits& limits) {
    const ImageKind kind = image_kind(bytes);
    if (kind != ImageKind::png && kind != ImageKind::jpeg) return;
    const ImageHeader header = read_image_header(bytes);
    if (header.width == 0 && header.height == 0) fail(name, "it has no image header");
    check_size(name, header.width, header.height, limits);
    const std::string defect = kind == ImageKind::png ? png_chunk_defect(bytes) : std::string();
    if (!defect.empty()) fail(name, defect);
    const std::uint64_t most = kind == ImageKind::png ? 1032 * bytes.size() : 1024 * bytes.size();
    const std::uint64_t needed = kind == ImageKind::png
                                     ? header.height * ((header.width * header.pixel_bits + 7) / 8)
                                     : header.width * header.height;
    if (needed > most)
        fail(name, "it claims " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                       " pixels, which its " + std::to_string(bytes.size()) + " bytes cannot hold");
}

// The reader wrote `channels` values at the start of every pixel: 1 grey, 2 grey and alpha, 3 colour.
void spread_channels(std::vector<Pixel>& pixels, int channels) {
    if (channels == 3)
        for (Pixel& pixel : pixels) pixel[3] = 255;
    if (channels == 1)
        for (Pixel& pixel : pixels) pixel = {pixel[0], pixel[0], pixel[0], 255};
    if (channels == 2)
        for (Pixel& pixel : pixels) pixel = {pixel[0], pixel[0], pixel[0], pixel[1]};
}

std::vector<Pixel> read_pixels(OIIO::ImageInput& input, const std::string& name) {
    const OIIO::ImageSpec spec = input.spec();
    const auto width = static_cast<std::size_t>(spec.width), height = static_cast<std::size_t>(spec.height);
    const int channels = std::min(spec.nchannels, 4);
    std::vector<Pixel> pixels(width * height);
    const bool linear =
        spec.format.basetype == OIIO::TypeDesc::FLOAT || spec.format.basetype == OIIO::TypeDesc::HALF;
    if (!linear) {
        if (!input.read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, pixels.data(), sizeof(Pixel)))
            fail(name, input.geterror());
    } else {
        std::vector<std::array<float, 4>> values(pixels.size());
        if (!input.read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data(), sizeof(values[0])))
            fail(name, input.geterror());
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
    const std::string format = reader_name(bytes, name);
    check_claim(name, bytes, limits);

    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    // Without "ioproxy" a reader would open the file of that name instead of these bytes.
    if (!input || input->supports("ioproxy") == 0) {
        (void)OIIO::geterror();
        throw Error(ExitCode::unsupported, name + ": this build reads no " + format +
                                               " images from memory; convert it to PNG or JPEG");
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec config;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&proxy));
    config.attribute("oiio:UnassociatedAlpha", 1);

    Texture texture;
    texture.name = name;
    try {
        OIIO::ImageSpec spec;
        if (!input->open("memory." + format, spec, config)) fail(name, input->geterror());
        if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels < 1)
            fail(name, "it is not a flat picture");
        check_size(name, static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height),
                   limits);
        Image image;
        image.width = static_cast<std::uint32_t>(spec.width);
        image.height = static_cast<std::uint32_t>(spec.height);
        image.pixels = read_pixels(*input, name);
        texture.mips.push_back(std::move(image));
        input->close();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail(name, error.what());
    }
    build_mips(texture);
    return texture;
}

} // namespace spa::import
