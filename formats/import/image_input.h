// SPDX-License-Identifier: Apache-2.0
// A picture in memory opened by OpenImageIO, after its claims were judged: what texture.cpp and picture.cpp
// share.
#pragma once

#include "import.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace spa::import {

// Throws Error{invalid_data}: `name` cannot be decoded, and why.
[[noreturn]] void fail_image(const std::string& name, const std::string& why);

class ImageInput {
public:
    // Recognises the format by content, by the extension of `name` only for TGA, which has no signature. The
    // picture is flat, has at least one channel and at most limits.texture_pixels pixels; alpha stays
    // straight. bytes: outlive this. Throws Error: invalid_data for what is none, unsupported for a format
    // that OpenImageIO was built without. The messages start with `name`. What OpenImageIO itself throws
    // passes through.
    ImageInput(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);

    [[nodiscard]] OIIO::ImageInput& reader() { return *reader_; }
    [[nodiscard]] const OIIO::ImageSpec& spec() const { return spec_; }
    // Whether values are linear light (float) or sRGB codes (whole numbers).
    [[nodiscard]] bool linear() const;

private:
    OIIO::Filesystem::IOMemReader memory_;
    OIIO::Filesystem::IOProxy* proxy_ = nullptr; // the reader is told where this pointer lies
    std::unique_ptr<OIIO::ImageInput> reader_;
    OIIO::ImageSpec spec_;
};

} // namespace spa::import
