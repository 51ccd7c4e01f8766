// SPDX-License-Identifier: Apache-2.0
#include "png.h"

#include "../libspa/core/error.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>

namespace spa::samples {

std::vector<std::byte> encode_png(const Image& image, const std::string& name) {
    const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(),
                                    [](const auto& pixel) { return pixel[3] == 255; });
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), opaque ? 3 : 4,
                         OIIO::TypeDesc::UINT8);
    // Straight alpha in and out: without this OpenImageIO takes colours for premultiplied.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("image.png", &sink);
    if (!output || !output->open("image.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data(), 4) || !output->close())
        throw Error(ExitCode::internal, "texture '" + name + "' cannot be encoded as PNG: " +
                                            (output ? output->geterror() : OIIO::geterror()));
    std::vector<std::byte> result(bytes.size());
    std::transform(bytes.begin(), bytes.end(), result.begin(), [](unsigned char b) { return std::byte(b); });
    return result;
}

} // namespace spa::samples
