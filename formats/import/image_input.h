// SPDX-License-Identifier: Apache-2.0
// A picture in memory opened by OpenImageIO, after its claims were judged: what texture.cpp and picture.cpp
// share.
#pragma once

#include "import.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace spa::import {

// Throws Error{invalid_data}: `name` cannot be decoded, and why.
[[noreturn]] void fail_image(const std::string& name, const std::string& why);

// Both are PNG, JPEG, WebP, BMP, TGA or TIFF, a picture may be OpenEXR too. Other readers of OpenImageIO are
// not let near the bytes.
enum class ImageUse { texture, picture };

class ImageInput {
public:
    // Recognises the format by content, by the extension of `name` only for TGA, which has no signature. The
    // picture is flat, has at least one channel and at most limits.texture_pixels pixels; alpha stays
    // straight; metadata are left out. bytes: outlive this. Throws Error: invalid_data for what is none and
    // for what claims more than its bytes can hold, unsupported for other formats and those that OpenImageIO
    // was built without. The messages start with `name`. What OpenImageIO itself throws passes through.
    ImageInput(std::span<const std::byte> bytes, const std::string& name, ImageUse use, const Limits& limits);

    [[nodiscard]] OIIO::ImageInput& reader() { return *reader_; }
    [[nodiscard]] const OIIO::ImageSpec& spec() const { return spec_; }
    // Whether values are linear light (float) or sRGB codes (whole numbers).
    [[nodiscard]] bool linear() const;

private:
    std::vector<std::byte> storage_; // a picture without its metadata
    std::optional<OIIO::Filesystem::IOMemReader> memory_;
    OIIO::Filesystem::IOProxy* proxy_ = nullptr; // the reader is told where this pointer lies
    std::unique_ptr<OIIO::ImageInput> reader_;
    OIIO::ImageSpec spec_;
};

} // namespace spa::import
