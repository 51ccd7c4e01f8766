// SPDX-License-Identifier: Apache-2.0
#include "surface_view.h"

#include <algorithm>
#include <cmath>

namespace spa::tools {

namespace {

constexpr Rgb black{0, 0, 0};

std::uint8_t byte_at(const ImageView& image, std::uint32_t x, std::uint32_t y, std::size_t channel) {
    return std::to_integer<std::uint8_t>(image.at(x, y)[channel]);
}

// Pictures are shrunk to a few hundred pixels to be looked at, so squares grow with the picture.
std::uint8_t checkerboard(const ImageView& image, std::uint32_t x, std::uint32_t y) {
    const std::uint32_t square = std::max(1U, image.width / 32);
    return (x / square + y / square) % 2 == 0 ? 96 : 144;
}

} // namespace

Picture color_picture(const ImageView& color) {
    Picture picture(color.width, color.height, black);
    for (std::uint32_t y = 0; y < color.height; ++y)
        for (std::uint32_t x = 0; x < color.width; ++x) {
            const std::uint32_t alpha = byte_at(color, x, y, 3);
            const std::uint32_t behind = checkerboard(color, x, y) * (255 - alpha);
            for (std::size_t c = 0; c < 3; ++c)
                picture.at(x, y)[c] = std::uint8_t((byte_at(color, x, y, c) * alpha + behind + 127) / 255);
        }
    return picture;
}

Picture coverage_picture(const ImageView& color) {
    Picture picture(color.width, color.height, black);
    for (std::uint32_t y = 0; y < color.height; ++y)
        for (std::uint32_t x = 0; x < color.width; ++x) picture.at(x, y).fill(byte_at(color, x, y, 3));
    return picture;
}

Picture depth_picture(const ImageView& depth) {
    Picture picture(depth.width, depth.height, black);
    for (std::uint32_t y = 0; y < depth.height; ++y)
        for (std::uint32_t x = 0; x < depth.width; ++x) {
            const float value = decode_depth(depth.format, depth.at(x, y));
            if (value > 0) picture.at(x, y) = viridis(double(value));
        }
    return picture;
}

Picture normal_picture(const ImageView& normal, const ImageView& depth, Mapping mapping) {
    Picture picture(normal.width, normal.height, black);
    const auto code = [](float v) {
        return std::uint8_t(std::lround(std::clamp(v * 0.5F + 0.5F, 0.0F, 1.0F) * 255));
    };
    for_each_texel(normal, depth, mapping, [&](std::uint32_t x, std::uint32_t y, bool has_surface) {
        if (!has_surface) return;
        const Vec3f n = decode_normal(normal.format, normal.at(x, y));
        picture.at(x, y) = {code(n.x), code(n.y), code(n.z)};
    });
    return picture;
}

DepthStatistics depth_statistics(const ImageView& depth, Mapping mapping) {
    DepthStatistics result;
    const Grid grid{mapping, depth.width, depth.height};
    double sphere = 0;
    for (std::uint32_t y = 0; y < depth.height; ++y)
        for (std::uint32_t x = 0; x < depth.width; ++x) {
            const double weight = solid_angle(grid, {x, y});
            sphere += weight;
            const float value = decode_depth(depth.format, depth.at(x, y));
            // Not `<= 0`: a NaN in an f32 image is no depth either.
            if (!(value > 0)) continue;
            result.coverage += weight;
            const double bins = double(result.histogram.size());
            result.histogram[std::size_t(std::clamp(double(value) * bins, 0.0, bins - 1))] += weight;
            result.min = result.min == 0 ? value : std::min(result.min, value);
            result.max = std::max(result.max, value);
        }
    result.coverage /= sphere;
    for (double& bin : result.histogram) bin /= sphere;
    return result;
}

} // namespace spa::tools
