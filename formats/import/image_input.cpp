// SPDX-License-Identifier: Apache-2.0
#include "image_input.h"

#include "../../libspa/core/error.h"
#include "image_header.h"
#include "image_stream.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace spa::import {
namespace {

// By content, by the extension only for TGA, which has no signature.
ImageKind kind_of(std::span<const std::byte> bytes, const std::string& name) {
    const ImageKind kind = image_kind(bytes);
    if (kind != ImageKind::unknown) return kind;
    std::string extension = std::filesystem::path(name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".tga") return ImageKind::tga;
    fail_image(name, bytes.empty() ? "it is empty" : "its first bytes are those of no known image format");
}

// OpenImageIO's name of the reader.
const char* reader_name(ImageKind kind, const std::string& name, ImageUse use) {
    const auto refuse = [&](const char* format) {
        throw Error(ExitCode::unsupported,
                    name + ": is a " + format + " image, which is not read; use PNG or JPEG");
    };
    switch (kind) {
    case ImageKind::png: return "png";
    case ImageKind::jpeg: return "jpeg";
    case ImageKind::webp: return "webp";
    case ImageKind::bmp: return "bmp";
    case ImageKind::tga: return "targa";
    case ImageKind::tiff: return "tiff";
    case ImageKind::exr:
        if (use == ImageUse::texture) refuse("OpenEXR");
        return "openexr";
    case ImageKind::gif: refuse("GIF"); break;
    case ImageKind::psd: refuse("Photoshop"); break;
    case ImageKind::dds: refuse("DDS"); break;
    case ImageKind::hdr: refuse("Radiance"); break;
    case ImageKind::ktx: refuse("KTX"); break;
    case ImageKind::unknown: break;
    }
    return "";
}

void check_size(const std::string& name, std::uint64_t width, std::uint64_t height, const Limits& limits) {
    if (width == 0 || height == 0) fail_image(name, "it claims no pixels");
    if (width > limits.texture_pixels / height)
        fail_image(name, "it claims " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels, more than the limit of " + std::to_string(limits.texture_pixels));
}

// What a small file may claim where its format has no bound, as for one of a single colour.
constexpr std::uint64_t free_pixels = std::uint64_t{1} << 24U;

// The most pixels that so many bytes can hold; at least free_pixels where there is no such bound. Deflate
// makes at most 1032 bytes of one (RFC 1951: 258 bytes of one 2-bit code). A JPEG block of 64 pixels takes at
// least half a bit in any mode that is in use. BMP and TGA without runs of equal pixels are stored pixel by
// pixel.
std::uint64_t most_pixels(ImageKind kind, const ImageHeader& header, std::uint64_t bytes) {
    const std::uint64_t most = 1024 * bytes;
    if (kind == ImageKind::jpeg) return most;
    const bool stored = (kind == ImageKind::bmp || kind == ImageKind::tga) && !header.packed;
    if (stored && header.pixel_bits != 0) return 8 * bytes / header.pixel_bits;
    return std::max(most, free_pixels);
}

// Refuses what claims more than its bytes can hold. OpenEXR is held against the limit alone.
void check_claim(const std::string& name, std::span<const std::byte> bytes, ImageKind kind,
                 const Limits& limits) {
    const ImageHeader header = read_image_header(bytes, kind);
    if (header.width == 0 && header.height == 0) fail_image(name, "it has no image header");
    check_size(name, header.width, header.height, limits);
    if (header.tile_pixels > std::max(free_pixels, header.width * header.height))
        fail_image(name, "it claims tiles of " + std::to_string(header.tile_pixels) + " pixels");
    if (kind == ImageKind::exr) return;
    const bool fits =
        kind == ImageKind::png
            ? header.height * ((header.width * header.pixel_bits + 7) / 8) <= 1032 * bytes.size()
            : header.width * header.height <= most_pixels(kind, header, bytes.size());
    if (!fits)
        fail_image(name, "it claims " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                             " pixels, which its " + std::to_string(bytes.size()) + " bytes cannot hold");
}

// Real progressive files have about ten.
constexpr std::size_t most_scans = 100;

// The bytes of the picture alone, if there are others.
std::optional<std::vector<std::byte>> essential_bytes(const std::string& name,
                                                      std::span<const std::byte> bytes, ImageKind kind) {
    if (kind == ImageKind::png) {
        const std::string defect = png_chunk_defect(bytes);
        if (!defect.empty()) fail_image(name, defect);
        return essential_png(bytes);
    }
    if (kind != ImageKind::jpeg) return std::nullopt;
    const std::size_t scans = jpeg_scans(bytes);
    if (scans > most_scans)
        fail_image(name, "it has " + std::to_string(scans) + " scans, more than the limit of " +
                             std::to_string(most_scans));
    return essential_jpeg(bytes);
}

// What a reader holds at once is a few rows or tiles of all channels.
void check_spec(const std::string& name, const OIIO::ImageSpec& spec, const Limits& limits) {
    constexpr std::uint64_t most_row_bytes = std::uint64_t{1} << 26U;
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels < 1)
        fail_image(name, "it is not a flat picture");
    check_size(name, std::uint64_t(spec.width), std::uint64_t(spec.height), limits);
    if (spec.scanline_bytes(true) > most_row_bytes)
        fail_image(name, "it claims " + std::to_string(spec.nchannels) + " channels of " +
                             std::to_string(spec.width) + " pixels a row");
    if (spec.tile_width > 0 && spec.tile_height > 0)
        check_size(name, std::uint64_t(spec.tile_width), std::uint64_t(spec.tile_height), limits);
}

} // namespace

void fail_image(const std::string& name, const std::string& why) {
    throw Error(ExitCode::invalid_data, name + ": cannot be decoded as an image: " + why);
}

ImageInput::ImageInput(std::span<const std::byte> bytes, const std::string& name, ImageUse use,
                       const Limits& limits) {
    const ImageKind kind = kind_of(bytes, name);
    const std::string format = reader_name(kind, name, use);
    check_claim(name, bytes, kind, limits);
    if (auto essential = essential_bytes(name, bytes, kind)) {
        storage_ = std::move(*essential);
        bytes = storage_;
        check_claim(name, bytes, kind, limits);
    }
    memory_.emplace(const_cast<std::byte*>(bytes.data()), bytes.size());
    proxy_ = &*memory_;
    reader_ = OIIO::ImageInput::create(format);
    // Without "ioproxy" a reader would open the file of that name instead of these bytes.
    if (!reader_ || reader_->supports("ioproxy") == 0) {
        (void)OIIO::geterror();
        throw Error(ExitCode::unsupported, name + ": this build reads no " + format +
                                               " images from memory; convert it to PNG or JPEG");
    }
    OIIO::ImageSpec config;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&proxy_));
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!reader_->open("memory." + format, spec_, config)) fail_image(name, reader_->geterror());
    check_spec(name, spec_, limits);
}

bool ImageInput::linear() const {
    return spec_.format.basetype == OIIO::TypeDesc::FLOAT || spec_.format.basetype == OIIO::TypeDesc::HALF;
}

} // namespace spa::import
