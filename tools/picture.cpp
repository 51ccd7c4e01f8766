// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include "../libspa/core/element_format.h"

#include <algorithm>
#include <cmath>

namespace spa::tools {

Picture::Picture(std::uint32_t w, std::uint32_t h, Rgb fill)
    : width(w), height(h), pixels(std::size_t(w) * h, fill) {}

void paste(Picture& target, const Picture& source, std::uint32_t x, std::uint32_t y) {
    if (x >= target.width) return;
    const std::uint32_t width = std::min(source.width, target.width - x);
    for (std::uint32_t row = 0; row < source.height && y + row < target.height; ++row)
        std::copy_n(&source.at(0, row), width, &target.at(x, y + row));
}

namespace {

Picture enlarge(const Picture& picture, std::uint32_t factor) {
    Picture result(picture.width * factor, picture.height * factor, {});
    for (std::uint32_t y = 0; y < result.height; ++y)
        for (std::uint32_t x = 0; x < result.width; ++x) result.at(x, y) = picture.at(x / factor, y / factor);
    return result;
}

Picture reduce(const Picture& picture, std::uint32_t factor) {
    Picture result((picture.width + factor - 1) / factor, (picture.height + factor - 1) / factor, {});
    for (std::uint32_t y = 0; y < result.height; ++y)
        for (std::uint32_t x = 0; x < result.width; ++x) {
            std::array<std::uint32_t, 3> sum{};
            std::uint32_t count = 0;
            for (std::uint32_t v = y * factor; v < std::min((y + 1) * factor, picture.height); ++v)
                for (std::uint32_t u = x * factor; u < std::min((x + 1) * factor, picture.width); ++u) {
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.at(u, v)[c];
                    ++count;
                }
            for (std::size_t c = 0; c < 3; ++c)
                result.at(x, y)[c] = std::uint8_t((sum[c] + count / 2) / count);
        }
    return result;
}

} // namespace

Picture scale_to_fit(const Picture& picture, std::uint32_t max_width) {
    if (picture.pixels.empty()) return {};
    if (picture.width <= max_width) return enlarge(picture, std::max(1U, max_width / picture.width));
    return reduce(picture, (picture.width + max_width - 1) / max_width);
}

Picture tone_map(std::uint32_t width, std::uint32_t height, std::span<const Vec3f> pixels, double exposure) {
    const SrgbEncoder code;
    const auto scale = float(std::exp2(exposure));
    Picture picture(width, height, {});
    std::transform(pixels.begin(), pixels.end(), picture.pixels.begin(), [&](Vec3f pixel) {
        return Rgb{code(pixel.x * scale), code(pixel.y * scale), code(pixel.z * scale)};
    });
    return picture;
}

Rgb viridis(double t) {
    constexpr std::array<Rgb, 9> colors{{{68, 1, 84},
                                         {71, 44, 122},
                                         {59, 81, 139},
                                         {44, 113, 142},
                                         {33, 144, 141},
                                         {39, 173, 129},
                                         {92, 200, 99},
                                         {170, 220, 50},
                                         {253, 231, 37}}};
    const double position = std::clamp(t, 0.0, 1.0) * double(colors.size() - 1);
    const std::size_t index = std::min(std::size_t(position), colors.size() - 2);
    const double f = position - double(index);
    Rgb color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = std::uint8_t(std::lround(colors[index][c] * (1 - f) + colors[index + 1][c] * f));
    return color;
}

} // namespace spa::tools
