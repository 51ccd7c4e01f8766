// SPDX-License-Identifier: Apache-2.0
#include "linear_picture.h"

#include "../../libspa/core/error.h"
#include "image_input.h"
#include "source_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace spa::import {
namespace {

using Channels = std::array<int, 3>; // of red, green and blue

constexpr std::size_t listed_channels = 12;

std::optional<Channels> channels_of(const OIIO::ImageSpec& spec, const std::string& prefix) {
    Channels channels{};
    constexpr std::array suffixes{"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) channels[c] = spec.channelindex(prefix + suffixes[c]);
    if (std::find(channels.begin(), channels.end(), -1) != channels.end()) return std::nullopt;
    return channels;
}

// Of the picture itself: a grey one has one channel, perhaps with alpha.
Channels main_channels(const OIIO::ImageSpec& spec, const std::string& name) {
    if (const std::optional<Channels> found = channels_of(spec, "")) return *found;
    if (spec.nchannels <= 2 && spec.alpha_channel != 0) return {0, 0, 0};
    std::string there;
    for (std::size_t c = 0; c < spec.channelnames.size() && c < listed_channels; ++c)
        there += (c == 0 ? "" : ", ") + spec.channelnames[c];
    if (spec.channelnames.size() > listed_channels) there += ", ...";
    fail_image(name, "it has no channels R, G and B; there are: " + there);
}

// The inverse of the sRGB transfer (IEC 61966-2-1) of a code in [0,1].
float linear_of_code(float code) {
    const double s = double(code);
    return float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

std::vector<Vec3f> read_channels(ImageInput& input, const Channels& channels, const std::string& name) {
    static_assert(sizeof(Vec3f) == 3 * sizeof(float));
    const OIIO::ImageSpec& spec = input.spec();
    std::vector<Vec3f> pixels(std::size_t(spec.width) * std::size_t(spec.height));
    const auto read = [&](int begin, int end, float* to) {
        if (!input.reader().read_image(0, 0, begin, end, OIIO::TypeDesc::FLOAT, to, sizeof(Vec3f)))
            fail_image(name, input.reader().geterror());
    };
    if (channels[1] == channels[0] + 1 && channels[2] == channels[0] + 2) {
        read(channels[0], channels[0] + 3, &pixels.front().x);
    } else {
        read(channels[0], channels[0] + 1, &pixels.front().x);
        read(channels[1], channels[1] + 1, &pixels.front().y);
        read(channels[2], channels[2] + 1, &pixels.front().z);
    }
    if (!input.linear())
        for (Vec3f& p : pixels) p = {linear_of_code(p.x), linear_of_code(p.y), linear_of_code(p.z)};
    return pixels;
}

LinearPicture decode(std::span<const std::byte> bytes, const std::string& name,
                     std::span<const std::string_view> layers, const Limits& limits) {
    ImageInput input(bytes, name, ImageUse::picture, limits);
    LinearPicture picture;
    picture.width = std::uint32_t(input.spec().width);
    picture.height = std::uint32_t(input.spec().height);
    picture.layers.push_back({"", read_channels(input, main_channels(input.spec(), name), name)});
    for (const std::string_view layer : layers)
        if (const auto channels = channels_of(input.spec(), std::string(layer) + "."))
            picture.layers.push_back({std::string(layer), read_channels(input, *channels, name)});
    return picture;
}

} // namespace

const PictureLayer* LinearPicture::find(std::string_view name) const {
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [&](const PictureLayer& layer) { return layer.name == name; });
    return found == layers.end() ? nullptr : &*found;
}

LinearPicture read_picture(const std::filesystem::path& path, std::span<const std::string_view> layers,
                           const Limits& limits) {
    const FileContent file = read_file(path, limits);
    try {
        return decode(file.bytes, path.string(), layers, limits);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail_image(path.string(), error.what());
    }
}

} // namespace spa::import
