// SPDX-License-Identifier: Apache-2.0
#include "model.h"

#include "../core/element_format.h"

#include <algorithm>
#include <cmath>

namespace spa {
namespace {

std::array<float, 256> srgb_table() {
    std::array<float, 256> table{};
    for (unsigned i = 0; i < 256; ++i) table[i] = srgb_to_linear(std::uint8_t(i));
    return table;
}

// Mean of the 2x2 texels at (2x, 2y); the last row and column of odd sizes are repeated where there is no
// second one.
std::array<std::uint8_t, 4> reduce(const Image& image, std::uint32_t x, std::uint32_t y,
                                   const std::array<float, 256>& linear) {
    std::array<float, 3> weighted{};
    std::array<float, 3> plain{};
    float alpha = 0;
    for (std::uint32_t j = 0; j < 2; ++j) {
        for (std::uint32_t i = 0; i < 2; ++i) {
            const std::size_t sx = std::min(2 * x + i, image.width - 1);
            const std::size_t sy = std::min(2 * y + j, image.height - 1);
            const auto& texel = image.pixels[sy * image.width + sx];
            const float a = float(texel[3]) / 255.0F;
            alpha += a;
            for (unsigned c = 0; c < 3; ++c) {
                plain[c] += linear[texel[c]];
                weighted[c] += linear[texel[c]] * a;
            }
        }
    }
    std::array<std::uint8_t, 4> out{};
    for (unsigned c = 0; c < 3; ++c) {
        out[c] = linear_to_srgb(alpha > 0 ? weighted[c] / alpha : plain[c] / 4);
    }
    out[3] = std::uint8_t(std::lround(alpha / 4 * 255));
    return out;
}

} // namespace

void build_mips(Texture& texture) {
    const auto linear = srgb_table();
    texture.mips.resize(1);
    while (texture.mips.back().width > 1 || texture.mips.back().height > 1) {
        const Image& from = texture.mips.back();
        Image to;
        to.width = std::max(1U, from.width / 2);
        to.height = std::max(1U, from.height / 2);
        to.pixels.resize(std::size_t(to.width) * to.height);
        for (std::uint32_t y = 0; y < to.height; ++y) {
            for (std::uint32_t x = 0; x < to.width; ++x) {
                to.pixels[std::size_t(y) * to.width + x] = reduce(from, x, y, linear);
            }
        }
        texture.mips.push_back(std::move(to));
    }
}

} // namespace spa
