// SPDX-License-Identifier: Apache-2.0
#include "surface_file.h"

#include "picture.h"
#include "surface_view.h"

#include <algorithm>
#include <cmath>

namespace spa::tools {

namespace {

ImageFile bytes_as_png(const ImageView& image, int channels) {
    const auto* samples = reinterpret_cast<const std::uint8_t*>(image.bytes.data());
    return {"png", encode_png8(image.width, image.height, channels, {samples, image.bytes.size()})};
}

std::size_t texels(const ImageView& image) { return std::size_t(image.width) * image.height; }

} // namespace

ImageFile color_file(const ImageView& color) { return bytes_as_png(color, 4); }

ImageFile depth_file(const ImageView& depth) {
    if (depth.format == ElementFormat::u8) return bytes_as_png(depth, 1);
    if (depth.format == ElementFormat::f32) {
        std::vector<float> values(texels(depth));
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = decode_depth(depth.format, depth.bytes.data() + i * sizeof(float));
        return {"exr", encode_exr(depth.width, depth.height, values)};
    }
    std::vector<std::uint16_t> codes(texels(depth));
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = std::uint16_t(std::to_integer<unsigned>(depth.bytes[2 * i]) |
                                 std::to_integer<unsigned>(depth.bytes[2 * i + 1]) << 8U);
    return {"png", encode_png16(depth.width, depth.height, 1, codes)};
}

ImageFile normal_file(const ImageView& normal, const ImageView& depth, Mapping mapping) {
    if (normal.format == ElementFormat::rgb8) return bytes_as_png(normal, 3);
    std::vector<std::uint16_t> samples(texels(normal) * 3, 0);
    const auto code = [](float v) {
        return std::uint16_t(std::lround(std::clamp(v * 0.5F + 0.5F, 0.0F, 1.0F) * 65535));
    };
    for_each_texel(normal, depth, mapping, [&](std::uint32_t x, std::uint32_t y, bool has_surface) {
        if (!has_surface) return;
        const Vec3f n = decode_normal(normal.format, normal.at(x, y));
        std::uint16_t* out = &samples[(std::size_t(y) * normal.width + x) * 3];
        out[0] = code(n.x);
        out[1] = code(n.y);
        out[2] = code(n.z);
    });
    return {"png", encode_png16(normal.width, normal.height, 3, samples)};
}

} // namespace spa::tools
