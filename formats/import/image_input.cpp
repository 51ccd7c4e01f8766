// SPDX-License-Identifier: Apache-2.0
#include "image_input.h"

#include "../../libspa/core/error.h"
#include "image_header.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace spa::import {
namespace {

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
    fail_image(name, bytes.empty() ? "it is empty" : "its first bytes are those of no known image format");
}

void check_size(const std::string& name, std::uint64_t width, std::uint64_t height, const Limits& limits) {
    if (width == 0 || height == 0) fail_image(name, "it claims no pixels");
    if (width > limits.texture_pixels / height)
        fail_image(name, "it claims " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels, more than the limit of " + std::to_string(limits.texture_pixels));
}

// Refuses what claims more than its bytes can hold. Deflate makes at most 1032 bytes of one (RFC 1951: 258
// bytes of one 2-bit code). A JPEG block of 64 pixels takes at least half a bit in any mode that is in use.
// OpenEXR has compressions without such a bound.
void check_claim(const std::string& name, std::span<const std::byte> bytes, const Limits& limits) {
    const ImageKind kind = image_kind(bytes);
    if (kind != ImageKind::png && kind != ImageKind::jpeg && kind != ImageKind::exr) return;
    const ImageHeader header = read_image_header(bytes);
    if (header.width == 0 && header.height == 0) fail_image(name, "it has no image header");
    check_size(name, header.width, header.height, limits);
    if (kind == ImageKind::exr) return;
    const std::string defect = kind == ImageKind::png ? png_chunk_defect(bytes) : std::string();
    if (!defect.empty()) fail_image(name, defect);
    const std::uint64_t most = kind == ImageKind::png ? 1032 * bytes.size() : 1024 * bytes.size();
    const std::uint64_t needed = kind == ImageKind::png
                                     ? header.height * ((header.width * header.pixel_bits + 7) / 8)
                                     : header.width * header.height;
    if (needed > most)
        fail_image(name, "it claims " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                             " pixels, which its " + std::to_string(bytes.size()) + " bytes cannot hold");
}

} // namespace

void fail_image(const std::string& name, const std::string& why) {
    throw Error(ExitCode::invalid_data, name + ": cannot be decoded as an image: " + why);
}

ImageInput::ImageInput(std::span<const std::byte> bytes, const std::string& name, const Limits& limits)
    : memory_(const_cast<std::byte*>(bytes.data()), bytes.size()), proxy_(&memory_) {
    const std::string format = reader_name(bytes, name);
    check_claim(name, bytes, limits);
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
    if (spec_.width <= 0 || spec_.height <= 0 || spec_.depth > 1 || spec_.nchannels < 1)
        fail_image(name, "it is not a flat picture");
    check_size(name, std::uint64_t(spec_.width), std::uint64_t(spec_.height), limits);
}

bool ImageInput::linear() const {
    return spec_.format.basetype == OIIO::TypeDesc::FLOAT || spec_.format.basetype == OIIO::TypeDesc::HALF;
}

} // namespace spa::import
