// SPDX-License-Identifier: Apache-2.0
// The encoders of picture.h.
#include "picture.h"

#include "../libspa/core/error.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <string>

namespace spa::tools {

namespace {

std::vector<std::byte> encode(const char* format, const OIIO::ImageSpec& spec, const void* samples) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto fail = [&](const std::string& why) {
        return Error(ExitCode::internal,
                     std::string("an image could not be encoded as ") + format + ": " + why);
    };
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output) throw fail(OIIO::geterror());
    output->set_ioproxy(&memory);
    // The name is only looked at for the format; nothing is opened.
    if (!output->open(std::string("memory.") + format, spec)) throw fail(output->geterror());
    if (!output->write_image(spec.format, samples)) throw fail(output->geterror());
    if (!output->close()) throw fail(output->geterror());
    const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
    return {data, data + bytes.size()};
}

OIIO::ImageSpec make_spec(std::uint32_t width, std::uint32_t height, int channels,
                          const OIIO::TypeDesc& type) {
    return {int(width), int(height), channels, type};
}

} // namespace

std::vector<std::byte> encode_png8(std::uint32_t width, std::uint32_t height, int channels,
                                   std::span<const std::uint8_t> samples) {
    OIIO::ImageSpec spec = make_spec(width, height, channels, OIIO::TypeDesc::UINT8);
    // Straight alpha, as it is stored; without this the writer takes it as premultiplied and divides.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (channels == 4) spec.attribute("oiio:ColorSpace", "sRGB");
    return encode("png", spec, samples.data());
}

std::vector<std::byte> encode_png16(std::uint32_t width, std::uint32_t height, int channels,
                                    std::span<const std::uint16_t> samples) {
    return encode("png", make_spec(width, height, channels, OIIO::TypeDesc::UINT16), samples.data());
}

std::vector<std::byte> encode_exr(std::uint32_t width, std::uint32_t height, std::span<const float> samples) {
    const ExrChannel luminance{"Y", samples};
    return encode_exr(width, height, {&luminance, 1});
}

std::vector<std::byte> encode_exr(std::uint32_t width, std::uint32_t height,
                                  std::span<const ExrChannel> channels) {
    OIIO::ImageSpec spec = make_spec(width, height, int(channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames.clear();
    for (const ExrChannel& channel : channels) spec.channelnames.push_back(channel.name);
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", ""); // otherwise the writer adds the present
    const std::size_t pixels = std::size_t(width) * height;
    std::vector<float> together(pixels * channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c)
        for (std::size_t i = 0; i < pixels; ++i)
            together[i * channels.size() + c] = channels[c].samples[i * channels[c].stride];
    return encode("exr", spec, together.data());
}

std::vector<std::byte> encode_png(const Picture& picture) {
    static_assert(sizeof(Rgb) == 3);
    return encode_png8(picture.width, picture.height, 3,
                       {picture.pixels.front().data(), picture.pixels.size() * 3});
}

} // namespace spa::tools
