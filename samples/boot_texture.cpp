// SPDX-License-Identifier: Apache-2.0
#include "boot_texture.h"

#include <algorithm>
#include <cmath>

namespace spa::samples {
namespace {

constexpr std::uint32_t size = 256;

// Brightness of a plain weave: threads of 4 pixels pass over and under each other in turn, darker at their
// edges.
double weave(std::uint32_t x, std::uint32_t y) {
    const bool warp_on_top = (x / 4 + y / 4) % 2 == 0;
    const std::uint32_t across = (warp_on_top ? x : y) % 4;
    return (warp_on_top ? 1.0 : 0.96) - (across == 0 || across == 3 ? 0.05 : 0.0);
}

} // namespace

Image boot_texture() {
    Image image{size, size, {}};
    image.pixels.reserve(std::size_t(size) * size);
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const double light = weave(x, y);
            const auto code = [light](double value) {
                return static_cast<std::uint8_t>(std::lround(value * light));
            };
            if (x < size / 2)
                image.pixels.push_back({code(240), code(126), code(20), 255});
            else
                image.pixels.push_back({code(28), code(84), code(215), 255});
        }
    }
    return image;
}

} // namespace spa::samples
